// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/belief/belief.h"
#include "core/plan/trajectory_timing.h"

namespace plumescout::testing {

// A corridor along x that is too narrow for two, 10 m long, with a bay to the north from x = 5 m to
// 7 m, and robots in it.
struct CorridorTeam {
  static constexpr std::int64_t kNow_ns = 100'000'000'000;
  static constexpr double kMiddle_m = 0.45;

  CorridorTeam() {
    const GridGeometry geometry{0.0, 0.0, 0.1, 100, 24};
    Grid<std::uint8_t> traversable(geometry, 0);
    for (std::size_t i = 0; i < traversable.size(); ++i) {
      const Cell cell = geometry.CellAtIndex(i);
      const bool in_corridor = cell.y >= 2 && cell.y < 7;
      const bool in_bay = cell.x >= 50 && cell.x < 70 && cell.y >= 7 && cell.y < 22;
      traversable[i] = in_corridor || in_bay ? 1 : 0;
    }
    belief.revision = 1;
    belief.sample_time_ns = kNow_ns;
    belief.options = std::make_shared<const MissionOptions>();
    belief.occupancy = std::make_shared<const Grid<CellState>>(geometry, CellState::kFree);
    belief.traversable = std::make_shared<const Grid<std::uint8_t>>(std::move(traversable));
    belief.gas_mean_ppm = std::make_shared<const Grid<float>>(geometry, 0.0F);
    belief.gas_variance_ppm2 = std::make_shared<const Grid<float>>(geometry, 1.0F);
    belief.sampled = std::make_shared<const Grid<std::uint8_t>>(geometry, 0);
  }

  static Point2 At(double x_m, double y_m = kMiddle_m) { return {x_m, y_m}; }
  void Stands(const RobotId& robot, double x_m, double y_m = kMiddle_m) {
    RobotRecord& record = belief.robots[robot];
    record.state.id = robot;
    record.state.radius_m = 0.2;
    record.state.has_pose = true;
    record.state.pose = {x_m, y_m, 0.0};
  }
  void Wants(const RobotId& robot, double x_m, double since_s) {
    RobotRecord& record = belief.robots[robot];
    record.wanted_goal =
        Goal{GoalKind::kHome, belief.geometry().CellAt(At(x_m)), At(x_m), At(x_m), 0};
    record.wanted_since_ns = belief.sample_time_ns - std::llround(since_s * 1e9);
  }
  void Drives(const RobotId& robot, double x_m) {
    RobotRecord& record = belief.robots[robot];
    const Trajectory way =
        TimeTrajectory({record.state.pose.position(), At(x_m)}, 0.0, PlanningOptions());
    record.live_arrival_ns = belief.sample_time_ns + std::llround(way.duration_s * 1e9);
    record.live_trajectory = std::make_shared<const Trajectory>(way);
    record.live_goal = Goal{GoalKind::kHome, {}, At(x_m), At(x_m), 0};
  }

  Belief belief;
};

}  // namespace plumescout::testing
