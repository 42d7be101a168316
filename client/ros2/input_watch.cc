// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/input_watch.h"

#include "absl/strings/str_cat.h"

namespace plumescout::client {

std::vector<std::string> InputWatch::Missing() const {
  std::vector<std::string> missing;
  const auto pose = intake_.LatestPose();
  if (!pose.ok()) {
    missing.emplace_back(pose.status().message());
  } else if (pose->time_ns == pose_time_before_ns_) {
    missing.emplace_back("no news of the robot's place");
  }
  const IntakeCounters& counters = intake_.counters();
  if (!names_.scan.empty() && counters.scans == before_.scans) {
    missing.emplace_back("no scan that could be placed");
  }
  if (!names_.gas.empty() && counters.gas_readings == before_.gas_readings) {
    missing.emplace_back("no gas reading that could be placed");
  }
  if (missing.empty()) return missing;
  if (const absl::Status waiting = intake_.Waiting(); !waiting.ok()) {
    missing.emplace_back(waiting.message());
  }
  for (const DdsNode::Source& source : node_.Sources()) {
    if (source.publishers == 0) missing.push_back(absl::StrCat("nobody publishes ", source.topic));
  }
  return missing;
}

void InputWatch::Begin() {
  before_ = intake_.counters();
  const auto pose = intake_.LatestPose();
  if (pose.ok()) pose_time_before_ns_ = pose->time_ns;
}

}  // namespace plumescout::client
