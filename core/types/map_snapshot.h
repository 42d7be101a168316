// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/frontier.h"
#include "core/types/grid.h"
#include "core/types/ids.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"

namespace plumescout {

struct RobotState {
  RobotId id;
  double radius_m = 0.2;
  bool has_pose = false;
  Pose2 pose;
  std::int64_t applied_sequence = 0;
  std::int64_t rejected_observations = 0;

  friend bool operator==(const RobotState&, const RobotState&) = default;
};

// What waits, moved or was merged on its way into the gas posterior; nothing is dropped silently.
struct GasCounters {
  std::int64_t readings = 0;            // received
  std::int64_t in_posterior = 0;        // on a free cell now
  std::int64_t moved_to_neighbour = 0;  // of those, moved to the nearest free cell, one cell away
  std::int64_t waiting = 0;             // their cell is not free (yet, or any more)

  friend bool operator==(const GasCounters&, const GasCounters&) = default;
};

// A whole map as readers see it at one revision. Off the free cells mean and variance are NaN.
struct MapSnapshot {
  std::int64_t revision = 0;
  Grid<CellState> occupancy;
  Grid<float> gas_mean_ppm;
  Grid<float> gas_variance_ppm2;
  double gas_threshold_ppm = 0.0;   // tau_gas of [XIT] Eq. (17)
  std::vector<Frontier> frontiers;  // both kinds
  std::vector<RobotState> robots;
  GasCounters gas_counters;
  MissionPhase phase = MissionPhase::kExploring;
};

}  // namespace plumescout
