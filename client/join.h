// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "absl/status/statusor.h"
#include "client/planner_client.h"
#include "core/types/gas_sensor.h"
#include "core/types/ids.h"
#include "core/types/options.h"

namespace plumescout::client {

// Which robot takes part in which mission.
struct Participation {
  MissionId mission;
  RobotId robot;
  double radius_m = 0.2;
  bool take_over = false;                               // supersede a lease that is still held
  std::int64_t log_epoch = 0;                           // see RobotRegistered
  RobotFrame frame = {};                                // of the robot's poses
  std::vector<GasSensor> sensors = {};                  // none: one, calibrated, at its pose
  std::optional<MissionOptions> create = std::nullopt;  // create the mission if it is not there
};

// Creates the mission if asked to and needed, then registers the robot.
absl::StatusOr<RobotSession> Join(PlannerClient& client, const Participation& participation);

}  // namespace plumescout::client
