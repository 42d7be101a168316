// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/grid.h"
#include "core/types/options.h"
#include "lab/rivals/kernel_dmv.h"
#include "lab/sim/metrics.h"
#include "lab/sim/scene_world.h"

namespace plumescout::lab {

// One robot, one building, one way to plan.
struct Trial {
  const MissionOptions* mission = nullptr;  // its seed is the trial's
  const SceneWorld* world = nullptr;
  std::uint64_t seed = 1;             // of planner and sensors
  double duration_s = 300.0;          // simulated, [XIT] section VI-B
  std::vector<double> map_times_s{};  // when the gas map is kept, ascending
  // Also map the same readings by Kernel DM+V, over the whole building, and tell its error.
  std::optional<KernelDmvOptions> peer{};
};

struct CurvePoint {
  double time_s = 0.0;
  MapMetrics metrics;
};

struct TrialRecord {
  std::vector<CurvePoint> curve;      // at 0, every 5 s, and at the end
  std::vector<Grid<float>> mean_ppm;  // at the map times, on the scene's grid; NaN: not estimated
  int gas_readings = 0;
  double distance_m = 0.0;
  int plans = 0;
  int collisions = 0;
  bool completed = false;               // the planner said so before the time was up
  std::optional<double> peer_rmse_ppm;  // of Kernel DM+V in critical cells, at the end
};

// Drives the robot through the building, planned in this process, in lockstep: the same trial gives
// the same record on any machine. The posterior is brought up to date where plans and metrics ask
// for it. Errors: as RunEpisode.
absl::StatusOr<TrialRecord> RunTrial(const Trial& trial);

}  // namespace plumescout::lab
