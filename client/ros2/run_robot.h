// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "client/robot_flags.h"
#include "client/ros2/ros2_flags.h"
#include "core/types/stop.h"

namespace plumescout::client {

struct RunFlags {
  RobotFlags robot = {};
  ListenFlags listen = {};
  TellFlags tell = {};
  bool simulated_clock = false;      // it does not keep real time
  double patience_s = 60.0;          // for the robot's place, before it joins
  double arrival_tolerance_m = 0.0;  // 0: that of who drives
};

// Puts a robot of ROS 2 into a mission until that is complete, the time is up, or `stop` says so.
// Lines for people begin with the name of the program.
absl::Status RunRobot(RunFlags flags, const StopFn& stop, const std::string& program);

}  // namespace plumescout::client
