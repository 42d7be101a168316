// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "client/ros2/map_publisher.h"
#include "client/ros2/plan_publisher.h"
#include "client/ros2/robot_intake.h"
#include "client/ros2/robot_topics.h"

namespace CLI {
class App;
}

namespace plumescout::client {

// How a robot of ROS 2 is listened to.
struct ListenFlags {
  int domain = 0;
  TopicNames topics = {};
  IntakeOptions intake = {};
  std::string gas_calibration = {};  // empty: none
};

// What it is told.
struct TellFlags {
  PlanPublisherOptions plan = {};
  MapPublisherOptions map = {};
  double map_period_s = 1.0;  // 0: maps are not published
};

// The flags must outlive the parsing.
void AddListenFlags(CLI::App& app, ListenFlags& flags);
void AddTellFlags(CLI::App& app, TellFlags& flags);

// What follows from what was parsed. kInvalidArgument quoting the calibration that is none.
absl::Status Prepare(ListenFlags& flags);
// Namespace, frames and where the robot's frame lies are those that it is listened to with.
void Prepare(const ListenFlags& listen, const RobotFrame& frame, TellFlags& flags);

}  // namespace plumescout::client
