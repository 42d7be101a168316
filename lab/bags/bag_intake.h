// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include "absl/status/status.h"
#include "client/ros2/robot_intake.h"
#include "core/types/observation.h"
#include "core/types/pose2.h"
#include "lab/bags/bag_reader.h"

namespace plumescout::lab {

struct BagTopics {
  std::string scan = "/scan";
  std::string odometry = "/odom";
  std::string tf = "/tf";
  std::string tf_static = "/tf_static";
  std::string gas = "/PID/Sensor_reading";

  std::set<std::string> all() const { return {scan, odometry, tf, tf_static, gas}; }
};

// Makes observations of what a bag has of a robot, as plumescout-ros2 does of what it hears; the
// times at which the recorder heard stand for those at which it would have.
class BagIntake {
 public:
  using Sink = std::function<absl::Status(std::int64_t sample_time_ns, const Pose2& pose,
                                          ObservationPayload payload)>;

  BagIntake(const BagTopics& topics, const client::IntakeOptions& options,
            client::RobotIntake::Complain complain, Sink sink);

  // What makes no sense is counted and passed over. Errors are those of the sink.
  absl::Status Take(const BagMessage& message);
  // What still waits for its place is given up.
  absl::Status Finish();

  const client::IntakeCounters& counters() const { return intake_.counters(); }
  std::int64_t jumps() const { return intake_.jumps(); }

 private:
  void Hear(const BagMessage& message);
  template <typename Message, typename HearMessage>
  void HearAs(const BagMessage& message, HearMessage hear);
  absl::Status HandOn();

  const BagTopics topics_;
  client::RobotIntake intake_;
  const Sink sink_;
  std::int64_t log_time_ns_ = 0;
};

}  // namespace plumescout::lab
