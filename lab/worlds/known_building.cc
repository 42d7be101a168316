// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/known_building.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/gas/gas_map.h"
#include "core/grid/flood.h"
#include "core/occupancy/free_space.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"
#include "lab/worlds/bench_world.h"

namespace plumescout::lab {
namespace {

constexpr int kPlumes = 3;
constexpr double kPeak_ppm = 40.0;
constexpr double kPlumeWidth_m = 3.0;
constexpr double kCellsPerReading = 64.0;

Grid<CellState> StatesOf(const Grid<std::uint8_t>& walls) {
  Grid<CellState> states(walls.geometry());
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i] = walls[i] != 0 ? CellState::kOccupied : CellState::kFree;
  }
  return states;
}

Cell RandomCell(const Grid<std::uint8_t>& mask, Rng& rng) {
  while (true) {
    const std::size_t index = rng.Below(mask.size());
    if (mask[index] != 0) return mask.geometry().CellAtIndex(index);
  }
}

// Readings in random free cells.
void Read(const Grid<CellState>& states, Rng& rng, GasMap& gas) {
  const GridGeometry& geometry = states.geometry();
  std::vector<Point2> plumes;
  for (int i = 0; i < kPlumes; ++i) {
    plumes.push_back(geometry.Center(geometry.CellAtIndex(rng.Below(states.size()))));
  }
  const auto readings = static_cast<int>(static_cast<double>(states.size()) / kCellsPerReading);
  for (int k = 0; k < readings; ++k) {
    const Cell cell = geometry.CellAtIndex(rng.Below(states.size()));
    if (states[cell] != CellState::kFree) continue;
    double concentration_ppm = 0.0;
    for (const Point2 plume : plumes) {
      const double distance = Distance_m(plume, geometry.Center(cell)) / kPlumeWidth_m;
      concentration_ppm += kPeak_ppm * std::exp(-distance * distance);
    }
    gas.Add(0, geometry.Center(cell), {concentration_ppm, {}});
  }
}

// The largest part of the building that a robot can drive about in.
Grid<std::uint8_t> LargestPart(const Grid<std::uint8_t>& traversable, Rng& rng) {
  Grid<std::uint8_t> part;
  do {
    part = ReachableCells(traversable, {RandomCell(traversable, rng)});
  } while (std::count(part.values().begin(), part.values().end(), 1) * 2 <
           std::count(traversable.values().begin(), traversable.values().end(), 1));
  return part;
}

}  // namespace

absl::StatusOr<RandomWorld> MakeKnownBuilding(int width_cells, int height_cells, std::uint64_t seed,
                                              int goal_count) {
  Rng rng(seed);
  const auto options = std::make_shared<const MissionOptions>();
  const Grid<CellState> states = StatesOf(MakeBuilding(width_cells, height_cells, seed));
  GasMap gas(options->gas);
  Read(states, rng, gas);
  PLUMESCOUT_RETURN_IF_ERROR(gas.Refresh(states, 0));

  RandomWorld world;
  world.robot = "r";
  Belief& belief = world.belief;
  belief.revision = 1;
  belief.options = options;
  belief.occupancy = std::make_shared<const Grid<CellState>>(states);
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(
      TraversableCells(states, options->occupancy.inflation_radius_m));
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(gas.mean_ppm());
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(gas.variance_ppm2());
  belief.gas_what_if = gas.what_if();
  const Grid<std::uint8_t> part = LargestPart(*belief.traversable, rng);
  const Point2 at = belief.geometry().Center(RandomCell(part, rng));
  RobotRecord& record = belief.robots[world.robot];
  record.state.id = world.robot;
  record.state.has_pose = true;
  record.state.pose = {at.x_m, at.y_m, 0.0};
  for (int i = 0; i < goal_count; ++i) {
    Goal goal;
    goal.cell = RandomCell(part, rng);
    goal.position = belief.geometry().Center(goal.cell);
    goal.centroid = goal.position;
    world.goals.push_back(goal);
  }
  return world;
}

}  // namespace plumescout::lab
