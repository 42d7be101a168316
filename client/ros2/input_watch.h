// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/ros2/dds_node.h"
#include "client/ros2/robot_intake.h"
#include "client/ros2/robot_topics.h"

namespace plumescout::client {

// Looks at what a robot has to publish: its place, scans, gas readings.
class InputWatch {
 public:
  // What is not listened to is not missed. Both must outlive it.
  InputWatch(const TopicNames& names, const RobotIntake& intake, const DdsNode& node)
      : names_(names), intake_(intake), node_(node) {}

  // What has not come since the last Begin, by name; empty: all has.
  std::vector<std::string> Missing() const;
  void Begin();

 private:
  const TopicNames names_;
  const RobotIntake& intake_;
  const DdsNode& node_;
  IntakeCounters before_;
  std::int64_t pose_time_before_ns_ = 0;
};

}  // namespace plumescout::client
