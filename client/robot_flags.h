// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "client/grpc_client_options.h"
#include "client/log_store.h"
#include "client/robot_loop_options.h"
#include "client/robot_recording.h"

namespace CLI {
class App;
}

namespace plumescout::client {

// What programs that put a robot into a mission are told on their command line, whatever the robot
// speaks.
struct RobotFlags {
  GrpcClientOptions client = {};
  RobotLoopOptions loop = {};
  bool create_mission = false;
  std::string prior_map = {};  // empty: none
  std::vector<std::string> gas_sensors = {};
  std::string record_folder = {};  // empty: the run is not recorded
  double log_sync_period_s = absl::ToDoubleSeconds(LogStoreOptions().sync_period);
};

// `flags` must outlive the parsing.
void AddRobotFlags(CLI::App& app, RobotFlags& flags);

// Makes what the loop and the client need of what was parsed: reads files, draws the log's epoch.
// Errors name the flag's value or the file.
absl::Status Prepare(RobotFlags& flags);

// How the run is recorded. What the recorder says of itself is for people alone.
RobotRecordingOptions RecordingOf(const RobotFlags& flags, const std::string& program);

}  // namespace plumescout::client
