// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/belief/belief.h"
#include "core/plan/cost/information_map.h"
#include "core/types/grid.h"
#include "core/types/plan.h"
#include "core/types/rng.h"
#include "tests/support/grid_art.h"

namespace plumescout::testing {

// A map for planners, its origin off zero: rectangles thrown on free ground, so that there are
// corridors, corners that touch and sealed pockets.
inline Grid<std::uint8_t> RandomObstacles(int width, int height, int obstacles, Rng& rng) {
  Grid<std::uint8_t> traversable(GridGeometry{-1.3, 2.7, 0.1, width, height}, 1);
  constexpr std::uint64_t kMaxExtent = 12;
  for (int i = 0; i < obstacles; ++i) {
    const int x0 = static_cast<int>(rng.Below(static_cast<std::uint64_t>(width)));
    const int y0 = static_cast<int>(rng.Below(static_cast<std::uint64_t>(height)));
    const int x1 = std::min(width, x0 + 1 + static_cast<int>(rng.Below(kMaxExtent)));
    const int y1 = std::min(height, y0 + 1 + static_cast<int>(rng.Below(kMaxExtent)));
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) traversable[Cell{x, y}] = 0;
    }
  }
  return traversable;
}

// Information that rolls in waves over the traversable cells.
inline InformationMap WavyInformation(const Grid<std::uint8_t>& traversable, Rng& rng) {
  const double fx = rng.Uniform(0.05, 0.3);
  const double fy = rng.Uniform(0.05, 0.3);
  const double phase = rng.Uniform(0.0, 6.0);
  InformationMap information;
  information.value = Grid<float>(traversable.geometry(), 0.0F);
  information.penalty = Grid<float>(traversable.geometry(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < traversable.size(); ++i) {
    if (traversable[i] == 0) continue;
    const Cell cell = traversable.geometry().CellAtIndex(i);
    information.value[i] =
        static_cast<float>(0.5 + 0.5 * std::sin(fx * cell.x + phase) * std::cos(fy * cell.y));
    information.penalty[i] = std::max(kMinPenalty, 1.0F - information.value[i]);
    information.min_penalty = std::min(information.min_penalty, information.penalty[i]);
  }
  return information;
}

inline Cell RandomOpenCell(const Grid<std::uint8_t>& mask, Rng& rng) {
  while (true) {
    const std::size_t index = rng.Below(mask.size());
    if (mask[index] != 0) return mask.geometry().CellAtIndex(index);
  }
}

inline Goal GoalAt(Cell cell, const GridGeometry& geometry) {
  Goal goal;
  goal.cell = cell;
  goal.position = geometry.Center(cell);
  goal.centroid = goal.position;
  return goal;
}

// The value of `raster` at points spread densely and evenly over the segment: a check of line
// integrals and collisions that knows nothing of grid traversal. Points within 1e-6 of a cell of
// an edge between cells belong to nobody and are left out.
inline std::vector<float> ValuesAlong(const Grid<float>& raster, Point2 a, Point2 b, int points) {
  std::vector<float> values;
  const GridGeometry& g = raster.geometry();
  for (int i = 0; i < points; ++i) {
    const double t = (i + 0.5) / points;
    const double x = (a.x_m + t * (b.x_m - a.x_m) - g.origin_x_m) / g.resolution_m;
    const double y = (a.y_m + t * (b.y_m - a.y_m) - g.origin_y_m) / g.resolution_m;
    constexpr double kEdge = 1e-6;
    if (std::abs(x - std::round(x)) < kEdge || std::abs(y - std::round(y)) < kEdge) continue;
    values.push_back(raster.At({static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))},
                               std::numeric_limits<float>::infinity()));
  }
  return values;
}

// Whether the polyline stays in cells with a finite value, looked at every hundredth of a cell.
inline bool StaysClear(const Grid<float>& penalty, const std::vector<Point2>& path) {
  constexpr double kPointsPerCell = 100.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double cells = Distance_m(path[i - 1], path[i]) / penalty.geometry().resolution_m;
    const int points = 2 + static_cast<int>(cells * kPointsPerCell);
    for (const float value : ValuesAlong(penalty, path[i - 1], path[i], points)) {
      if (!std::isfinite(value)) return false;
    }
  }
  return true;
}

// A belief without gas over a drawn map: free cells are traversable but where `inflated` marks
// them. The robot "r" stands in the cell drawn 'S', if there is one.
inline Belief BeliefFromArt(const GridArt& art, char inflated = 'i') {
  Belief belief;
  belief.revision = 1;
  belief.options = std::make_shared<const MissionOptions>();
  belief.occupancy = std::make_shared<const Grid<CellState>>(GridFromArt(art));
  belief.traversable =
      std::make_shared<const Grid<std::uint8_t>>(MaskFromArt(art, std::string("#?") + inflated));
  Grid<float> mean_ppm(belief.geometry(), std::numeric_limits<float>::quiet_NaN());
  belief.gas_mean_ppm = std::make_shared<const Grid<float>>(mean_ppm);
  belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(mean_ppm);
  belief.sampled = std::make_shared<const Grid<std::uint8_t>>(belief.geometry(), 0);
  RobotRecord& record = belief.robots["r"];
  record.state.id = "r";
  for (const Cell start : CellsInArt(art, 'S')) {
    const Point2 at = belief.geometry().Center(start);
    record.state.has_pose = true;
    record.state.pose = {at.x_m, at.y_m, 0.5};
  }
  return belief;
}

}  // namespace plumescout::testing
