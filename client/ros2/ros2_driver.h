// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "client/robot_driver.h"
#include "client/ros2/robot_intake.h"
#include "client/ros2/steady_clock.h"
#include "client/running_clock.h"
#include "core/types/stop.h"

namespace plumescout::client {

struct Ros2DriverOptions {
  bool has_scanner = true;
  // A robot of which nothing is heard for so long has ended.
  absl::Duration patience = absl::Seconds(10);
  // A robot of whose place nothing new is known for so long is not driven.
  absl::Duration pose_patience = absl::Seconds(1);
};

// How a driver hears and moves its robot.
struct Ros2Ports {
  // Has the intake hear what has come; waits for it if nothing has, at most so long.
  std::function<void(absl::Duration timeout)> listen;
  // Sends a velocity. Null: somebody else drives.
  std::function<absl::Status(const Twist&)> drive = nullptr;
  // What the intake has as `received_ns`: nanoseconds of a clock that nobody sets.
  std::function<std::int64_t()> steady_ns = client::Steady_ns;
};

// A robot of ROS 2. Its clock is that of the stamps that it sends, carried on between them.
class Ros2Driver final : public RobotDriver {
 public:
  // `intake` must outlive it.
  Ros2Driver(RobotIntake& intake, Ros2Ports ports, const Ros2DriverOptions& options);

  // Listens until a pose is known, and where a scan was measured: mounts of sensors may be heard
  // seconds after the first pose. kUnavailable naming what is missing after so long; kCancelled if
  // `stop` says so.
  absl::Status AwaitPlace(absl::Duration patience, const StopFn& stop);

  std::int64_t now_ns() const override { return now_ns_; }
  Pose2 pose() const override { return pose_; }
  // The newest that has not been taken yet.
  absl::StatusOr<Scan> TakeScan() override;
  absl::StatusOr<GasReading> ReadGas() override;
  std::int64_t sample_time_ns() const override { return sample_time_ns_; }
  Pose2 sample_pose() const override { return sample_pose_; }
  std::optional<PoseCorrection> TakeCorrection() override;

  // Zero instead if it is not known where the robot is.
  absl::Status Drive(const Twist& twist) override;
  absl::Status PlaceAt(const Pose2& pose) override;
  // Listens for so long, of real time; only until a scan comes once half of that is over, so that
  // who reads sensors after it finds them fresh. kUnavailable if the robot falls silent.
  absl::Status Advance(double duration_s) override;

  bool knows_place() const { return Steady_ns() - pose_heard_ns_ <= pose_patience_ns_; }

 private:
  std::int64_t Steady_ns() const { return ports_.steady_ns(); }
  void Listen(std::int64_t timeout_ns);
  absl::Status MissingPlace() const;
  void TakeInCorrections();
  void TakeInPose(std::int64_t steady_ns);
  void TakeInTime(std::int64_t steady_ns);
  template <typename Reading>
  absl::StatusOr<Reading> Take(std::optional<PlacedSample<Reading>>& sample);

  RobotIntake& intake_;
  const Ros2Ports ports_;
  const absl::Duration patience_;
  const std::int64_t pose_patience_ns_;
  const bool has_scanner_;
  RunningClock clock_;
  std::int64_t now_ns_ = 0;
  std::int64_t newest_ns_ = 0;  // that the robot has told of
  std::int64_t heard_ns_ = 0;   // when it did, by the steady clock
  bool has_pose_ = false;
  Pose2 pose_;
  std::int64_t pose_time_ns_ = 0;
  std::int64_t pose_heard_ns_ = 0;
  std::optional<PlacedSample<Scan>> scan_;
  bool has_new_scan_ = false;  // since Advance began
  std::optional<PlacedSample<GasReading>> gas_;
  std::deque<PoseCorrection> corrections_;  // each changes poses that the one before left
  std::optional<std::int64_t> first_taken_ns_;
  std::int64_t sample_time_ns_ = 0;
  Pose2 sample_pose_;
};

}  // namespace plumescout::client
