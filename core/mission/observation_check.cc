// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/observation_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/string_view.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr double kMaxAngle_rad = 1000.0;  // turns may add up, but not without end
constexpr std::int64_t kMaxClockLeap_ns = 86'400'000'000'000;  // one day
// Of the first observation too, so that all sums of times stay within 64 bits.
constexpr std::int64_t kMaxSampleTime_ns = (std::int64_t{1} << 62) - 1;
constexpr std::size_t kMostAnchors = 4096;  // an hour of keyframes a second apart
constexpr double kMinVariance_ppm2 = 1e-9;  // keeps precisions within Validate's
constexpr double kMaxVariance_ppm2 = 1e12;

absl::Status CheckPose(const Pose2& pose, double limit_m, absl::string_view parent = "") {
  return Checker()
      .InRange(absl::StrCat(parent, "pose.x_m"), pose.x_m, -limit_m, limit_m)
      .InRange(absl::StrCat(parent, "pose.y_m"), pose.y_m, -limit_m, limit_m)
      .InRange(absl::StrCat(parent, "pose.yaw_rad"), pose.yaw_rad, -kMaxAngle_rad, kMaxAngle_rad)
      .status();
}

absl::Status CheckPayload(const Scan& scan, const MissionOptions& options) {
  const std::size_t beams = scan.ranges_m.size();
  if (beams == 0 || beams > static_cast<std::size_t>(options.max_beam_count)) {
    return absl::InvalidArgumentError(
        absl::StrCat("scan.ranges has ", beams, " beams, must have 1 to ", options.max_beam_count));
  }
  const double step_rad = std::abs(scan.angle_step_rad);
  const double least_step_rad = beams > 1 ? 1e-9 : 0.0;
  return Checker()
      .InRange("scan.start_angle_rad", scan.start_angle_rad, -kMaxAngle_rad, kMaxAngle_rad)
      .Require(step_rad >= least_step_rad && step_rad <= 2.0 * M_PI, "scan.angle_step_rad",
               scan.angle_step_rad, "must be in [-2 pi, 2 pi] and not 0")
      .InRangeAbove("scan.max_range_m", scan.max_range_m, 0.0, options.max_range_m)
      .status();
}

absl::Status CheckPayload(const GasReading& gas, const MissionOptions& options) {
  const double variance_ppm2 = gas.variance_ppm2;
  const bool by_model = variance_ppm2 == 0.0;
  return Checker()
      .InRange("gas.concentration_ppm", gas.concentration_ppm, 0.0, options.max_concentration_ppm)
      .Require(
          by_model || (variance_ppm2 >= kMinVariance_ppm2 && variance_ppm2 <= kMaxVariance_ppm2),
          "gas.variance_ppm2", variance_ppm2, "must be 0 (the mission's model) or in [1e-9, 1e12]")
      .status();
}

absl::Status CheckPayload(const SequenceGap&, const MissionOptions&) { return absl::OkStatus(); }

absl::Status CheckPayload(const PoseCorrection& correction, const MissionOptions& options) {
  const std::vector<PoseAnchor>& anchors = correction.anchors;
  if (anchors.empty() || anchors.size() > kMostAnchors) {
    return absl::InvalidArgumentError(
        absl::StrCat("correction has ", anchors.size(), " anchors, must have 1 to ", kMostAnchors));
  }
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    const std::int64_t time_ns = anchors[i].sample_time_ns;
    const std::int64_t earlier_ns = i == 0 ? -1 : anchors[i - 1].sample_time_ns;
    if (time_ns <= earlier_ns || time_ns > kMaxSampleTime_ns) {
      return absl::InvalidArgumentError(
          absl::StrCat("correction.anchors[", i, "].sample_time_ns = ", time_ns,
                       " must be after the one before, ", earlier_ns, ", and below 2^62"));
    }
    PLUMESCOUT_RETURN_IF_ERROR(CheckPose(anchors[i].pose, options.pose_limit_m,
                                         absl::StrCat("correction.anchors[", i, "].")));
  }
  return absl::OkStatus();
}

absl::Status CheckPayload(const RobotStatus& status, const MissionOptions&) {
  return Checker().InRange("status.battery_share", status.battery_share, 0.0, 1.0).status();
}

}  // namespace

absl::Status CheckPlace(const Pose2& in_mission, double limit_m) {
  return Checker()
      .InRange("pose.x_m in frame map", in_mission.x_m, -limit_m, limit_m)
      .InRange("pose.y_m in frame map", in_mission.y_m, -limit_m, limit_m)
      .status();
}

absl::Status CheckStep(const WayPoint& before, const WayPoint& now, double max_robot_speed_mps) {
  constexpr double kJump_m = 5.0;
  constexpr double kSecondsPerNanosecond = 1e-9;
  const double elapsed_s = kSecondsPerNanosecond * static_cast<double>(std::max<std::int64_t>(
                                                       0, now.time_ns - before.time_ns));
  const double most_m = kJump_m + max_robot_speed_mps * elapsed_s;
  const double distance_m = Distance_m(before.pose.position(), now.pose.position());
  if (max_robot_speed_mps == 0.0 || distance_m <= most_m) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrFormat(
      "pose = (%.2f, %.2f) in frame map is %.2f m from the robot's last, (%.2f, %.2f), %.3f s "
      "before; it must be within %.2f m by max_robot_speed_mps = %g",
      now.pose.x_m, now.pose.y_m, distance_m, before.pose.x_m, before.pose.y_m, elapsed_s, most_m,
      max_robot_speed_mps));
}

std::int64_t MissionTime_ns(const Observation& observation, std::int64_t clock_offset_ns) {
  const std::int64_t time_ns = observation.sample_time_ns;
  if (time_ns < 0 || time_ns > kMaxSampleTime_ns) return time_ns;
  const std::int64_t mapped_ns = time_ns + clock_offset_ns;
  const bool is_gap = std::holds_alternative<SequenceGap>(observation.payload);
  return is_gap ? std::clamp<std::int64_t>(mapped_ns, 0, kMaxSampleTime_ns) : mapped_ns;
}

bool SaysWhen(const Observation& observation) {
  return observation.sample_time_ns != 0 ||
         !std::holds_alternative<SequenceGap>(observation.payload);
}

bool SaysWhere(const Observation& observation) {
  const bool need_not = std::holds_alternative<SequenceGap>(observation.payload) ||
                        std::holds_alternative<RobotStatus>(observation.payload);
  return !need_not || observation.pose != Pose2{};
}

absl::Status CheckObservation(const Observation& observation, const MissionOptions& options,
                              std::int64_t newest_sample_time_ns, std::int64_t clock_offset_ns) {
  const std::int64_t time_ns = MissionTime_ns(observation, clock_offset_ns);
  const auto refused = [&](const auto&... limit) {
    const std::string by_mission =
        time_ns == observation.sample_time_ns
            ? std::string()
            : absl::StrCat(" of the robot's clock, ", time_ns, " of the mission's,");
    return absl::InvalidArgumentError(absl::StrCat("sample_time_ns = ", observation.sample_time_ns,
                                                   by_mission, " must ", limit...));
  };
  if (time_ns < 0) return refused("be >= 0");
  if (time_ns > kMaxSampleTime_ns) return refused("be below 2^62");
  if (newest_sample_time_ns > 0 && time_ns - newest_sample_time_ns > kMaxClockLeap_ns) {
    return refused("not be more than a day after the mission's newest, ", newest_sample_time_ns);
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckPose(observation.pose, options.pose_limit_m));
  return std::visit([&](const auto& payload) { return CheckPayload(payload, options); },
                    observation.payload);
}

}  // namespace plumescout
