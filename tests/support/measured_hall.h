// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>

#include "core/belief/belief.h"

namespace plumescout::support {

// A closed hall of 20 x 10 free cells of 0.5 m, all of them measured, without gas, for `objective`;
// a robot is in it. What is on the grids can be changed.
struct MeasuredHall {
  explicit MeasuredHall(const ObjectiveOptions& objective, GasScale scale = GasScale::kLinear) {
    MissionOptions mission;
    mission.objective = objective;
    mission.gas.scale = scale;
    mission.frontier.min_occupancy_cell_count = 1;
    belief.options = std::make_shared<const MissionOptions>(mission);
    const GridGeometry geometry{0.0, 0.0, 0.5, 22, 12};
    occupancy = std::make_shared<Grid<CellState>>(geometry, CellState::kOccupied);
    traversable = std::make_shared<Grid<std::uint8_t>>(geometry, std::uint8_t{0});
    mean = std::make_shared<Grid<float>>(geometry, NAN);
    variance = std::make_shared<Grid<float>>(geometry, NAN);
    error_variance = std::make_shared<Grid<float>>(geometry, NAN);
    for (int y = 1; y <= 10; ++y) {
      for (int x = 1; x <= 20; ++x) Set({x, y}, 0.0F, 1.0F);
    }
    belief.occupancy = occupancy;
    belief.traversable = traversable;
    belief.gas_mean_ppm = mean;
    belief.gas_variance_ppm2 = variance;
    belief.gas_error_variance_ppm2 = error_variance;
    belief.gas_weight_variance_ppm2 = variance;
    belief.gas_counters.readings = 100;
    RobotRecord& robot = belief.robots["r"];
    robot.state.id = "r";
    robot.state.has_pose = true;
    robot.state.pose = {1.25, 1.25, 0.0};
  }

  // Free and measured, with this mean and published variance.
  void Set(Cell cell, float mean_ppm, float variance_ppm2) {
    (*occupancy)[cell] = CellState::kFree;
    (*traversable)[cell] = 1;
    (*mean)[cell] = mean_ppm;
    (*variance)[cell] = 0.01F;
    (*error_variance)[cell] = variance_ppm2;
  }
  void Forget(Cell cell) { (*variance)[cell] = 10.0F; }
  Point2 Center(Cell cell) const { return belief.geometry().Center(cell); }

  Belief belief;
  std::shared_ptr<Grid<CellState>> occupancy;
  std::shared_ptr<Grid<std::uint8_t>> traversable;
  std::shared_ptr<Grid<float>> mean;
  std::shared_ptr<Grid<float>> variance;
  std::shared_ptr<Grid<float>> error_variance;
};

inline ObjectiveOptions Objective(ObjectiveKind kind, double radius_m = 1.0) {
  return {.kind = kind, .threshold_ppm = 10.0, .radius_m = radius_m};
}

}  // namespace plumescout::support
