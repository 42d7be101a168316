// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/line_driver.h"

#include <errno.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr std::size_t kMostCorrections = 64;  // that wait to be sent
constexpr double kNanosecondsPerSecond = 1e9;
constexpr std::int64_t kClockStep_ns = 1'000'000'000;
// A scan of 100 000 beams takes about a megabyte; a longer line is no line of ours.
constexpr std::size_t kMaxLine_bytes = std::size_t{4} << 20;
constexpr std::size_t kReadBlock_bytes = std::size_t{1} << 16;

}  // namespace

absl::Status LineDriver::AwaitPose() {
  while (!pose_.has_value()) PLUMESCOUT_RETURN_IF_ERROR(TakeInLine());
  return absl::OkStatus();
}

template <typename Reading>
absl::StatusOr<Reading> LineDriver::Take(std::optional<LineSample<Reading>>& sample) {
  if (!sample.has_value()) return absl::UnavailableError("nothing new");
  sample_time_ns_ = sample->time_ns;
  sample_pose_ = sample->pose;
  Reading reading = std::move(sample->reading);
  sample.reset();
  return reading;
}

absl::StatusOr<Scan> LineDriver::TakeScan() { return Take(scan_); }

absl::StatusOr<GasReading> LineDriver::ReadGas() { return Take(gas_); }

std::optional<PoseCorrection> LineDriver::TakeCorrection() {
  if (corrections_.empty()) return std::nullopt;
  PoseCorrection first = std::move(corrections_.front());
  corrections_.pop_front();
  return first;
}

absl::Status LineDriver::Drive(const Twist& twist) {
  const std::int64_t unplaced_ns = now_ns_ - pose_time_ns_;
  const bool knows_place = unplaced_ns <= absl::ToInt64Nanoseconds(options_.pose_patience);
  const std::string line = FormatTwistLine(knows_place ? twist : Twist{});
  const absl::Time deadline = absl::Now() + options_.patience;
  std::size_t written = 0;
  while (written < line.size()) {
    // A pipe that has room takes a whole line.
    pollfd output{.fd = options_.output_fd, .events = POLLOUT, .revents = 0};
    const absl::Duration left = std::max(deadline - absl::Now(), absl::ZeroDuration());
    const int ready = poll(&output, 1, static_cast<int>(absl::ToInt64Milliseconds(left)));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return absl::UnavailableError("the robot program does not read its commands");
    const ssize_t count = write(options_.output_fd, line.data() + written, line.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return absl::UnavailableError("the robot program takes no commands any more");
    written += static_cast<std::size_t>(count);
  }
  return absl::OkStatus();
}

absl::Status LineDriver::PlaceAt(const Pose2&) {
  return absl::UnimplementedError("a real robot cannot be placed");
}

absl::Status LineDriver::Advance(double duration_s) {
  const std::int64_t duration_ns = std::llround(duration_s * kNanosecondsPerSecond);
  std::int64_t until_ns = now_ns_ + duration_ns;
  while (now_ns_ < until_ns) {
    const std::int64_t before_ns = now_ns_;
    PLUMESCOUT_RETURN_IF_ERROR(TakeInLine());
    if (now_ns_ < before_ns) until_ns = now_ns_ + duration_ns;
  }
  return absl::OkStatus();
}

absl::Status LineDriver::TakeInLine() {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::string text, ReadLine());
  absl::StatusOr<RobotLine> line = ParseRobotLine(text);
  const absl::Status status = line.ok() ? Digest(*std::move(line)) : line.status();
  if (!status.ok()) {
    ++bad_lines_;
    if (options_.on_bad_line) options_.on_bad_line(status);
  }
  return absl::OkStatus();
}

absl::Status LineDriver::Digest(RobotLine line) {
  if (const auto* status = std::get_if<RobotStatus>(&line.reading)) {
    status_ = *status;
    return absl::OkStatus();
  }
  if (line.pose.has_value()) pose_ = line.pose;
  if (!pose_.has_value()) return absl::FailedPreconditionError("a reading before the first pose");
  // Lines of two sensors may come in another order than they were measured; a clock that was set
  // back goes on from there.
  const bool was_set_back = line.time_ns < now_ns_ - kClockStep_ns;
  now_ns_ = was_set_back ? line.time_ns : std::max(now_ns_, line.time_ns);
  pose_time_ns_ = line.pose.has_value() ? now_ns_ : std::min(pose_time_ns_, now_ns_);
  if (auto* scan = std::get_if<Scan>(&line.reading)) {
    scan_ = {.time_ns = line.time_ns, .pose = *pose_, .reading = std::move(*scan)};
  } else if (const auto* gas = std::get_if<GasReading>(&line.reading)) {
    gas_ = {.time_ns = line.time_ns, .pose = *pose_, .reading = *gas};
  } else if (auto* correction = std::get_if<PoseCorrection>(&line.reading)) {
    if (corrections_.size() >= kMostCorrections) {
      return absl::ResourceExhaustedError("corrections come faster than they are sent");
    }
    corrections_.push_back(std::move(*correction));
    // What was not taken yet was measured at a pose that was wrong.
    scan_.reset();
    gas_.reset();
  }
  return absl::OkStatus();
}

absl::StatusOr<std::string> LineDriver::ReadLine() {
  const absl::Time deadline = absl::Now() + options_.patience;
  std::size_t searched = 0;
  while (true) {
    const std::size_t end = buffer_.find('\n', searched);
    if (end != std::string::npos) {
      std::string line = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return line;
    }
    if (buffer_.size() > kMaxLine_bytes) {
      return absl::UnavailableError("the robot program does not write lines");
    }
    searched = buffer_.size();
    PLUMESCOUT_RETURN_IF_ERROR(FillBuffer(deadline));
  }
}

absl::Status LineDriver::FillBuffer(absl::Time deadline) {
  pollfd input{.fd = options_.input_fd, .events = POLLIN, .revents = 0};
  const absl::Duration left = std::max(deadline - absl::Now(), absl::ZeroDuration());
  const int ready = poll(&input, 1, static_cast<int>(absl::ToInt64Milliseconds(left)));
  if (ready < 0 && errno == EINTR) return absl::OkStatus();
  if (ready == 0) {
    return absl::UnavailableError(absl::StrCat("the robot program has been silent for ",
                                               absl::FormatDuration(options_.patience)));
  }
  std::array<char, kReadBlock_bytes> block;
  const ssize_t count = read(options_.input_fd, block.data(), block.size());
  if (count < 0 && errno == EINTR) return absl::OkStatus();
  if (count <= 0) return absl::UnavailableError("the robot program has ended");
  buffer_.append(block.data(), static_cast<std::size_t>(count));
  return absl::OkStatus();
}

}  // namespace plumescout::client
