// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <variant>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/ros2/frame_jump.h"
#include "client/ros2/sensor_conversion.h"
#include "client/ros2/tf_buffer.h"
#include "core/types/gas_reading.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"
#include "formats/ros/messages.h"

namespace plumescout::client {

struct IntakeOptions {
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_link";
  double transform_wait_s = 0.5;  // so long a sample waits for where it was measured
  FrameJumpOptions jump;
  std::optional<GasCalibration> gas_calibration;
};

// What a sensor measured, when, and where it was itself then.
template <typename Reading>
struct PlacedSample {
  std::int64_t time_ns = 0;
  Pose2 pose;
  Reading reading;
};

struct IntakeCounters {
  std::int64_t scans = 0;         // handed on
  std::int64_t gas_readings = 0;  // handed on
  std::int64_t winds = 0;         // that make sense; missions have no use for them
  std::int64_t bad = 0;           // messages that were refused
  std::int64_t unplaced = 0;      // samples that were dropped for want of a transform
  std::int64_t overrun = 0;       // that were dropped since nobody took them
};

// In a sentence.
std::string Describe(const IntakeCounters& counters);

// Makes samples with poses of what a robot of ROS 2 publishes. Whatever makes no sense is counted,
// told of and passed over. Pure: `received_ns` is any clock that nobody sets.
class RobotIntake {
 public:
  // Told, by topic, what is wrong with a message. May be empty.
  using Complain = std::function<void(const std::string& about, const absl::Status&)>;

  explicit RobotIntake(const IntakeOptions& options, Complain complain = nullptr);

  void OnTransforms(const ros::TfMessage& message, bool is_static);
  // Its pose stands in for a transform that nobody publishes.
  void OnOdometry(const ros::Odometry& message);
  void OnScan(ros::LaserScan message, std::int64_t received_ns);
  void OnGas(ros::GasSensor message, std::int64_t received_ns);
  void OnWind(const ros::Anemometer& message);
  // A message that could not even be read.
  void Refuse(const std::string& about, const absl::Status& why);

  // The oldest sample of which it is known by now where it was measured.
  std::optional<PlacedSample<Scan>> TakeScan(std::int64_t received_ns);
  std::optional<PlacedSample<GasReading>> TakeGas(std::int64_t received_ns);
  // To be asked for before them.
  std::optional<PoseCorrection> TakeCorrection() { return jump_.Take(); }

  // Of the base, in frame map, and its time; the error names what is missing.
  absl::StatusOr<PlacedSample<std::monostate>> LatestPose() const;
  // The newest time that odometry or a sensor has told of; 0: none has yet.
  std::int64_t newest_ns() const { return newest_ns_; }
  // Why the oldest scan that waits does so, or if none does, the oldest gas reading; OK: neither.
  absl::Status Waiting() const;

  const IntakeCounters& counters() const { return counters_; }
  std::int64_t jumps() const { return jump_.jumps(); }

 private:
  template <typename Message>
  struct Pending {
    Message message;
    std::int64_t received_ns = 0;
  };
  template <typename Message>
  using Queue = std::deque<Pending<Message>>;

  template <typename Message>
  void Push(const std::string& about, Queue<Message>& queue, std::int64_t& last_ns, Message message,
            std::int64_t received_ns);
  // Where the first in the queue was measured, which then leaves it; drops those that waited long.
  template <typename Message>
  std::optional<Transform> PlaceFirst(const std::string& about, Queue<Message>& queue,
                                      std::int64_t received_ns, Message& message);
  void NoteTime(std::int64_t time_ns);

  const IntakeOptions options_;
  const Complain complain_;
  TfBuffer tf_;
  FrameJump jump_;
  std::set<std::string> of_odometry_;  // frames that no transform was published of
  Queue<ros::LaserScan> scans_;
  Queue<ros::GasSensor> gas_;
  std::int64_t last_scan_ns_ = 0;
  std::int64_t last_gas_ns_ = 0;
  std::int64_t newest_ns_ = 0;
  IntakeCounters counters_;
};

}  // namespace plumescout::client
