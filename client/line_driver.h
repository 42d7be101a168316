// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "absl/time/time.h"
#include "client/line_messages.h"
#include "client/robot_driver.h"

namespace plumescout::client {

struct LineDriverOptions {
  int input_fd = 0;   // lines of the robot program
  int output_fd = 1;  // lines to it
  // Silence of the robot program for this long is an error, and so is not reading its commands.
  absl::Duration patience = absl::Seconds(10);
  // Without a pose for so long, by the lines' clock, the robot is told to stand.
  absl::Duration pose_patience = absl::Seconds(1);
  // Told of lines that cannot be read; they are passed over. May be empty.
  std::function<void(const absl::Status&)> on_bad_line;
};

// What a line said of a sensor, with when and where it was measured.
template <typename Reading>
struct LineSample {
  std::int64_t time_ns = 0;
  Pose2 pose;
  Reading reading;
};

// A robot behind a pair of pipes: any program that writes poses, scans and gas readings as lines of
// JSON and takes velocity commands back. Its clock is that of the lines: time goes by as they come,
// and goes back only if that clock is set back.
class LineDriver final : public RobotDriver {
 public:
  explicit LineDriver(const LineDriverOptions& options) : options_(options) {}

  // Reads lines until a pose is known. kUnavailable if none comes.
  absl::Status AwaitPose();

  std::int64_t now_ns() const override { return now_ns_; }
  Pose2 pose() const override { return pose_.value_or(Pose2{}); }
  // The newest reading that has not been taken yet.
  absl::StatusOr<Scan> TakeScan() override;
  absl::StatusOr<GasReading> ReadGas() override;
  std::optional<RobotStatus> TakeStatus() override { return std::exchange(status_, std::nullopt); }
  std::int64_t sample_time_ns() const override { return sample_time_ns_; }
  Pose2 sample_pose() const override { return sample_pose_; }

  std::optional<PoseCorrection> TakeCorrection() override;

  absl::Status Drive(const Twist& twist) override;
  absl::Status PlaceAt(const Pose2& pose) override;
  // Reads lines until their clock has moved on so far. kUnavailable if the robot program falls
  // silent or ends.
  absl::Status Advance(double duration_s) override;

  std::int64_t bad_lines() const { return bad_lines_; }

 private:
  absl::StatusOr<std::string> ReadLine();
  absl::Status FillBuffer(absl::Time deadline);
  absl::Status TakeInLine();
  absl::Status Digest(RobotLine line);
  template <typename Reading>
  absl::StatusOr<Reading> Take(std::optional<LineSample<Reading>>& sample);

  const LineDriverOptions options_;
  std::string buffer_;  // read, not yet a line
  std::int64_t now_ns_ = 0;
  std::optional<Pose2> pose_;
  std::int64_t pose_time_ns_ = 0;
  std::optional<LineSample<Scan>> scan_;
  std::optional<LineSample<GasReading>> gas_;
  std::deque<PoseCorrection> corrections_;  // each changes poses that the one before left
  std::optional<RobotStatus> status_;
  std::int64_t sample_time_ns_ = 0;
  Pose2 sample_pose_;
  std::int64_t bad_lines_ = 0;
};

}  // namespace plumescout::client
