// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/ros2_driver.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr std::size_t kMostCorrections = 64;  // that wait to be sent
constexpr std::int64_t kSetBack_ns = 1'000'000'000;
constexpr std::int64_t kLook_ns = 100'000'000;  // waits are no longer at a time

}  // namespace

Ros2Driver::Ros2Driver(RobotIntake& intake, Ros2Ports ports, const Ros2DriverOptions& options)
    : intake_(intake),
      ports_(std::move(ports)),
      patience_(options.patience),
      pose_patience_ns_(absl::ToInt64Nanoseconds(options.pose_patience)),
      has_scanner_(options.has_scanner),
      clock_([this] { return absl::Nanoseconds(Steady_ns()); }),
      heard_ns_(Steady_ns()) {}

absl::Status Ros2Driver::MissingPlace() const {
  if (!has_pose_) return intake_.LatestPose().status();
  if (scan_ || !has_scanner_) return absl::OkStatus();
  const absl::Status waiting = intake_.Waiting();
  return absl::NotFoundError(
      absl::StrCat("no scan that could be placed", waiting.ok() ? "" : ": ", waiting.message()));
}

absl::Status Ros2Driver::AwaitPlace(absl::Duration patience, const StopFn& stop) {
  const std::int64_t end_ns = Steady_ns() + absl::ToInt64Nanoseconds(patience);
  for (absl::Status missing = MissingPlace(); !missing.ok(); missing = MissingPlace()) {
    if (stop()) return absl::CancelledError("told to stop before the robot's place was known");
    if (Steady_ns() >= end_ns) {
      return absl::UnavailableError(absl::StrCat("the robot's place is not known after ",
                                                 absl::FormatDuration(patience), ": ",
                                                 missing.message()));
    }
    Listen(kLook_ns);
  }
  return absl::OkStatus();
}

void Ros2Driver::Listen(std::int64_t timeout_ns) {
  ports_.listen(absl::Nanoseconds(timeout_ns));
  const std::int64_t steady_ns = Steady_ns();
  TakeInCorrections();
  while (auto scan = intake_.TakeScan(steady_ns)) {
    scan_ = std::move(scan);
    has_new_scan_ = true;
  }
  while (auto gas = intake_.TakeGas(steady_ns)) gas_ = std::move(gas);
  TakeInPose(steady_ns);
  TakeInTime(steady_ns);
}

void Ros2Driver::TakeInCorrections() {
  std::optional<PoseCorrection> correction = intake_.TakeCorrection();
  if (!correction) return;
  if (corrections_.size() >= kMostCorrections) corrections_.pop_front();
  corrections_.push_back(*std::move(correction));
  // What was not taken yet was placed where the robot was not.
  scan_.reset();
  gas_.reset();
}

void Ros2Driver::TakeInPose(std::int64_t steady_ns) {
  const auto latest = intake_.LatestPose();
  if (!latest.ok()) return;
  if (!has_pose_ || latest->time_ns != pose_time_ns_) pose_heard_ns_ = steady_ns;
  has_pose_ = true;
  pose_ = latest->pose;
  pose_time_ns_ = latest->time_ns;
}

void Ros2Driver::TakeInTime(std::int64_t steady_ns) {
  if (intake_.newest_ns() != newest_ns_) {
    newest_ns_ = intake_.newest_ns();
    heard_ns_ = steady_ns;
    clock_.Note(newest_ns_);
  }
  const std::int64_t now_ns = clock_.Now_ns();
  // Stamps come late by more or less; a clock that was set back goes on from there.
  now_ns_ = now_ns < now_ns_ - kSetBack_ns ? now_ns : std::max(now_ns, now_ns_);
}

template <typename Reading>
absl::StatusOr<Reading> Ros2Driver::Take(std::optional<PlacedSample<Reading>>& sample) {
  if (!sample) return absl::UnavailableError("nothing new");
  sample_time_ns_ = sample->time_ns;
  if (!first_taken_ns_) first_taken_ns_ = sample_time_ns_;
  sample_pose_ = sample->pose;
  Reading reading = std::move(sample->reading);
  sample.reset();
  return reading;
}

absl::StatusOr<Scan> Ros2Driver::TakeScan() { return Take(scan_); }

absl::StatusOr<GasReading> Ros2Driver::ReadGas() { return Take(gas_); }

std::optional<PoseCorrection> Ros2Driver::TakeCorrection() {
  while (!corrections_.empty()) {
    PoseCorrection first = std::move(corrections_.front());
    corrections_.pop_front();
    // Of what nobody took before nobody has a pose that could be wrong.
    auto& anchors = first.anchors;
    const auto begin =
        std::find_if(anchors.begin(), anchors.end(), [this](const PoseAnchor& anchor) {
          return first_taken_ns_ && anchor.sample_time_ns >= *first_taken_ns_;
        });
    anchors.erase(anchors.begin(), begin);
    if (!anchors.empty()) return first;
  }
  return std::nullopt;
}

absl::Status Ros2Driver::Drive(const Twist& twist) {
  if (!ports_.drive) return absl::OkStatus();
  return ports_.drive(knows_place() ? twist : Twist{});
}

absl::Status Ros2Driver::PlaceAt(const Pose2&) {
  return absl::UnimplementedError("a real robot cannot be placed");
}

absl::Status Ros2Driver::Advance(double duration_s) {
  const std::int64_t duration_ns = absl::ToInt64Nanoseconds(absl::Seconds(duration_s));
  const std::int64_t end_ns = Steady_ns() + duration_ns;
  bool goes_on = true;
  has_new_scan_ = false;
  do {
    Listen(std::clamp<std::int64_t>(end_ns - Steady_ns(), 0, kLook_ns));
    if (absl::Nanoseconds(Steady_ns() - heard_ns_) > patience_) {
      return absl::UnavailableError(
          absl::StrCat("nothing is heard of the robot's place and sensors for ",
                       absl::FormatDuration(patience_)));
    }
    const std::int64_t left_ns = end_ns - Steady_ns();
    goes_on = left_ns > 0 && !(has_new_scan_ && left_ns <= duration_ns / 2);
  } while (goes_on);
  return absl::OkStatus();
}

}  // namespace plumescout::client
