// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/observation_check.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr double kMaxAngle_rad = 1000.0;  // turns may add up, but not without end
constexpr std::int64_t kMaxClockLeap_ns = 86'400'000'000'000;  // one day
// Of the first observation too, so that all sums of times stay within 64 bits.
constexpr std::int64_t kMaxSampleTime_ns = (std::int64_t{1} << 62) - 1;
constexpr double kMinVariance_ppm2 = 1e-9;  // keeps precisions within Validate's
constexpr double kMaxVariance_ppm2 = 1e12;

absl::Status OutOfRange(absl::string_view field, double value, absl::string_view rule) {
  return absl::InvalidArgumentError(absl::StrCat(field, " = ", value, " ", rule));
}

// True for NaN too.
bool Outside(double value, double low, double high) { return !(value >= low && value <= high); }

absl::Status CheckPose(const Pose2& pose, double limit_m) {
  const std::string rule = absl::StrCat("must be in [", -limit_m, ", ", limit_m, "]");
  if (Outside(pose.x_m, -limit_m, limit_m)) return OutOfRange("pose.x_m", pose.x_m, rule);
  if (Outside(pose.y_m, -limit_m, limit_m)) return OutOfRange("pose.y_m", pose.y_m, rule);
  if (Outside(pose.yaw_rad, -kMaxAngle_rad, kMaxAngle_rad)) {
    return OutOfRange("pose.yaw_rad", pose.yaw_rad, "must be in [-1000, 1000]");
  }
  return absl::OkStatus();
}

absl::Status CheckPayload(const Scan& scan, const MissionOptions& options) {
  const std::size_t beams = scan.ranges_m.size();
  if (beams == 0 || beams > static_cast<std::size_t>(options.max_beam_count)) {
    return absl::InvalidArgumentError(
        absl::StrCat("scan.ranges has ", beams, " beams, must have 1 to ", options.max_beam_count));
  }
  if (Outside(scan.start_angle_rad, -kMaxAngle_rad, kMaxAngle_rad)) {
    return OutOfRange("scan.start_angle_rad", scan.start_angle_rad, "must be in [-1000, 1000]");
  }
  if (Outside(std::abs(scan.angle_step_rad), beams > 1 ? 1e-9 : 0.0, 2.0 * M_PI)) {
    return OutOfRange("scan.angle_step_rad", scan.angle_step_rad,
                      "must be in [-2 pi, 2 pi] and not 0");
  }
  if (!(scan.max_range_m > 0.0) || scan.max_range_m > options.max_range_m) {
    return OutOfRange("scan.max_range_m", scan.max_range_m,
                      absl::StrCat("must be in (0, ", options.max_range_m, "]"));
  }
  return absl::OkStatus();
}

absl::Status CheckPayload(const GasReading& gas, const MissionOptions& options) {
  if (Outside(gas.concentration_ppm, 0.0, options.max_concentration_ppm)) {
    return OutOfRange("gas.concentration_ppm", gas.concentration_ppm,
                      absl::StrCat("must be in [0, ", options.max_concentration_ppm, "]"));
  }
  if (gas.variance_ppm2 != 0.0 &&
      Outside(gas.variance_ppm2, kMinVariance_ppm2, kMaxVariance_ppm2)) {
    return OutOfRange("gas.variance_ppm2", gas.variance_ppm2,
                      "must be 0 (the mission's model) or in [1e-9, 1e12]");
  }
  return absl::OkStatus();
}

absl::Status CheckPayload(const SequenceGap&, const MissionOptions&) { return absl::OkStatus(); }

}  // namespace

absl::Status CheckObservation(const Observation& observation, const MissionOptions& options,
                              std::int64_t newest_sample_time_ns) {
  if (observation.sample_time_ns < 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("sample_time_ns = ", observation.sample_time_ns, " must be >= 0"));
  }
  if (observation.sample_time_ns > kMaxSampleTime_ns) {
    return absl::InvalidArgumentError(
        absl::StrCat("sample_time_ns = ", observation.sample_time_ns, " must be below 2^62"));
  }
  if (newest_sample_time_ns > 0 &&
      observation.sample_time_ns - newest_sample_time_ns > kMaxClockLeap_ns) {
    return absl::InvalidArgumentError(absl::StrCat(
        "sample_time_ns = ", observation.sample_time_ns,
        " must not be more than a day after the mission's newest, ", newest_sample_time_ns));
  }
  PLUMESCOUT_RETURN_IF_ERROR(CheckPose(observation.pose, options.pose_limit_m));
  return std::visit([&](const auto& payload) { return CheckPayload(payload, options); },
                    observation.payload);
}

}  // namespace plumescout
