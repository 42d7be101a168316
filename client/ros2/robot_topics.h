// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "client/ros2/dds_node.h"
#include "client/ros2/robot_intake.h"

namespace plumescout::client {

// Below the robot's namespace, unless they begin with a slash; an empty one is not listened to.
struct TopicNames {
  std::string ros_namespace = {};
  std::string scan = "scan";
  std::string odometry = "odom";
  std::string tf = "tf";
  std::string tf_static = "tf_static";
  std::string gas = "PID/Sensor_reading";
  std::string wind = "Anemometer/WindSensor_reading";
};

// Has the intake hear what the robot publishes, whenever the node is polled. What cannot be read is
// refused there. `intake` must outlive the node.
absl::Status ListenToRobot(const TopicNames& names, DdsNode& node, RobotIntake& intake);

}  // namespace plumescout::client
