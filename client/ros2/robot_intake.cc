// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/robot_intake.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

constexpr std::size_t kMostPending = 32;  // of one sensor
constexpr double kNanosecondsPerSecond = 1e9;
// A clock set back by more than this goes on from there; less is a message out of order.
constexpr std::int64_t kClockStep_ns = 10'000'000'000;
// A planar scanner may lean so far: cosine of a sixth of a right angle.
constexpr double kLevel = 0.966;

bool MayCome(const absl::Status& status) {
  return absl::IsNotFound(status) || absl::IsUnavailable(status);
}

std::int64_t TimeOf_ns(const ros::Header& header) { return ros::ToNanoseconds(header.stamp); }

}  // namespace

std::string Describe(const IntakeCounters& counters) {
  return absl::StrCat("heard ", counters.scans, " scans, ", counters.gas_readings,
                      " gas readings, ", counters.winds, " of wind; refused ", counters.bad,
                      ", without a place ", counters.unplaced, ", not taken in time ",
                      counters.overrun);
}

RobotIntake::RobotIntake(const IntakeOptions& options, Complain complain)
    : options_(options), complain_(std::move(complain)), jump_(options.jump) {
  tf_.HoldNewest(options_.odom_frame);
}

void RobotIntake::Refuse(const std::string& about, const absl::Status& why) {
  ++counters_.bad;
  if (complain_) complain_(about, why);
}

void RobotIntake::NoteTime(std::int64_t time_ns) {
  const bool was_set_back = time_ns < newest_ns_ - kClockStep_ns;
  newest_ns_ = was_set_back ? time_ns : std::max(newest_ns_, time_ns);
}

void RobotIntake::OnTransforms(const ros::TfMessage& message, bool is_static) {
  for (const ros::TransformStamped& transform : message.transforms) {
    const std::string& child = transform.child_frame_id;
    of_odometry_.erase(child);
    const Transform* const newest = tf_.Newest(options_.odom_frame);
    const std::optional<Transform> before =
        newest != nullptr && child == options_.odom_frame ? std::optional(*newest) : std::nullopt;
    if (absl::Status status = tf_.Add(transform, is_static); !status.ok()) {
      Refuse(is_static ? "/tf_static" : "/tf", status);
      continue;
    }
    if (before) jump_.Move(*before, *tf_.Newest(child));
    if (child == options_.base_frame && !is_static) NoteTime(TimeOf_ns(transform.header));
  }
}

void RobotIntake::OnOdometry(const ros::Odometry& message) {
  const std::string& child = message.child_frame_id;
  if (tf_.Has(child) && of_odometry_.count(child) == 0) return;
  const absl::Status status = tf_.Add(
      {.header = message.header, .child_frame_id = child, .transform = message.pose}, false);
  if (!status.ok()) return Refuse("odometry", status);
  of_odometry_.insert(child);
  if (child == options_.base_frame) NoteTime(TimeOf_ns(message.header));
}

template <typename Message>
void RobotIntake::Push(const std::string& about, Queue<Message>& queue, std::int64_t& last_ns,
                       Message message, std::int64_t received_ns) {
  const std::int64_t time_ns = TimeOf_ns(message.header);
  if (time_ns <= last_ns && time_ns > last_ns - kClockStep_ns) {
    return Refuse(about, absl::InvalidArgumentError(absl::StrCat("time runs backwards: stamp ",
                                                                 time_ns, " after ", last_ns)));
  }
  if (message.header.frame_id.empty()) {
    return Refuse(about, absl::InvalidArgumentError("header.frame_id is empty"));
  }
  last_ns = time_ns;
  NoteTime(time_ns);
  if (queue.size() >= kMostPending) {
    queue.pop_front();
    ++counters_.overrun;
  }
  queue.push_back({std::move(message), received_ns});
}

void RobotIntake::OnScan(ros::LaserScan message, std::int64_t received_ns) {
  if (const auto scan = ToScan(message, /*upside_down=*/false); !scan.ok()) {
    return Refuse("scan", scan.status());
  }
  Push("scan", scans_, last_scan_ns_, std::move(message), received_ns);
}

void RobotIntake::OnGas(ros::GasSensor message, std::int64_t received_ns) {
  if (const auto reading = ToGasReading(message, options_.gas_calibration); !reading.ok()) {
    return Refuse("gas", reading.status());
  }
  Push("gas", gas_, last_gas_ns_, std::move(message), received_ns);
}

void RobotIntake::OnWind(const ros::Anemometer& message) {
  if (absl::Status status = CheckWind(message); !status.ok()) return Refuse("wind", status);
  ++counters_.winds;
}

template <typename Message>
std::optional<Transform> RobotIntake::PlaceFirst(const std::string& about, Queue<Message>& queue,
                                                 std::int64_t received_ns, Message& message) {
  const auto patience_ns =
      static_cast<std::int64_t>(options_.transform_wait_s * kNanosecondsPerSecond);
  while (!queue.empty()) {
    const ros::Header& header = queue.front().message.header;
    const absl::StatusOr<Transform> place =
        tf_.Lookup(options_.map_frame, header.frame_id, TimeOf_ns(header));
    const bool waits =
        MayCome(place.status()) && received_ns - queue.front().received_ns < patience_ns;
    if (waits) return std::nullopt;
    message = std::move(queue.front().message);
    queue.pop_front();
    if (place.ok()) return *place;
    ++counters_.unplaced;
    if (complain_) complain_(about, place.status());
  }
  return std::nullopt;
}

std::optional<PlacedSample<Scan>> RobotIntake::TakeScan(std::int64_t received_ns) {
  ros::LaserScan message;
  while (const auto place = PlaceFirst("scan", scans_, received_ns, message)) {
    const double upright = Upright(*place);
    if (std::abs(upright) < kLevel) {
      Refuse("scan", absl::InvalidArgumentError(
                         absl::StrCat("frame ", message.header.frame_id, " is not level")));
      continue;
    }
    absl::StatusOr<Scan> scan = ToScan(message, upright < 0.0);
    if (!scan.ok()) continue;  // it was well when it came
    const std::int64_t time_ns = TimeOf_ns(message.header);
    const auto in_odom = tf_.Lookup(options_.odom_frame, message.header.frame_id, time_ns);
    if (in_odom.ok()) jump_.NoteSensed(time_ns, *in_odom, *place);
    ++counters_.scans;
    return PlacedSample<Scan>{time_ns, ToPlanar(*place), *std::move(scan)};
  }
  return std::nullopt;
}

std::optional<PlacedSample<GasReading>> RobotIntake::TakeGas(std::int64_t received_ns) {
  ros::GasSensor message;
  const auto place = PlaceFirst("gas", gas_, received_ns, message);
  if (!place) return std::nullopt;
  const auto reading = ToGasReading(message, options_.gas_calibration);
  if (!reading.ok()) return std::nullopt;  // it was well when it came
  ++counters_.gas_readings;
  return PlacedSample<GasReading>{TimeOf_ns(message.header), ToPlanar(*place), *reading};
}

absl::StatusOr<PlacedSample<std::monostate>> RobotIntake::LatestPose() const {
  const std::string& map = options_.map_frame;
  const std::string& base = options_.base_frame;
  const auto time_ns = tf_.NewestTime_ns(map, base);
  PLUMESCOUT_ASSIGN_OR_RETURN(const Transform place,
                              tf_.Lookup(map, base, time_ns.value_or(newest_ns_)));
  return PlacedSample<std::monostate>{time_ns.value_or(newest_ns_), ToPlanar(place), {}};
}

absl::Status RobotIntake::Waiting() const {
  const auto why = [this](const ros::Header& header) {
    return tf_.Lookup(options_.map_frame, header.frame_id, TimeOf_ns(header)).status();
  };
  absl::Status waiting;
  if (!scans_.empty()) waiting.Update(why(scans_.front().message.header));
  if (!gas_.empty()) waiting.Update(why(gas_.front().message.header));
  return waiting;
}

}  // namespace plumescout::client
