// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/pose_error.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr double kMaxPosition_m = 10.0;
constexpr double kMaxYaw_rad = 3.2;
constexpr double kMinClosing_s = 1.0;
constexpr double kMaxClosing_s = 3600.0;

// Without an error the pose stays as it is, to the last bit.
Pose2 Sum(const Pose2& pose, const Pose2& drift, const Pose2& noise) {
  const Pose2 error{drift.x_m + noise.x_m, drift.y_m + noise.y_m, drift.yaw_rad + noise.yaw_rad};
  if (error == Pose2{}) return pose;
  return {pose.x_m + error.x_m, pose.y_m + error.y_m, WrapAngle_rad(pose.yaw_rad + error.yaw_rad)};
}

}  // namespace

absl::Status Validate(const PoseErrorOptions& options) {
  if (options.jump) PLUMESCOUT_RETURN_IF_ERROR(Validate(*options.jump));
  if (options.jump && options.closed_every_s) {
    return absl::InvalidArgumentError(
        absl::StrCat("pose_error.closed_every_s = ", *options.closed_every_s,
                     " must be unset with pose_error.jump"));
  }
  return Checker()
      .InRange("pose_error.closed_every_s", options.closed_every_s.value_or(kMinClosing_s),
               kMinClosing_s, kMaxClosing_s)
      .InRange("pose_error.position_sigma_m", options.position_sigma_m, 0.0, kMaxPosition_m)
      .InRange("pose_error.yaw_sigma_rad", options.yaw_sigma_rad, 0.0, kMaxYaw_rad)
      .InRange("pose_error.drift_m_per_sqrt_s", options.drift_m_per_sqrt_s, 0.0, kMaxPosition_m)
      .InRange("pose_error.drift_rad_per_sqrt_s", options.drift_rad_per_sqrt_s, 0.0, kMaxYaw_rad)
      .status();
}

PoseError::PoseError(const PoseErrorOptions& options, std::uint64_t seed)
    : options_(options), rng_(seed) {
  DrawNoise();
}

void PoseError::Advance(double duration_s) {
  if (options_ == PoseErrorOptions{}) return;
  const double root_s = std::sqrt(duration_s);
  drift_.x_m += options_.drift_m_per_sqrt_s * root_s * rng_.Gaussian();
  drift_.y_m += options_.drift_m_per_sqrt_s * root_s * rng_.Gaussian();
  drift_.yaw_rad += options_.drift_rad_per_sqrt_s * root_s * rng_.Gaussian();
  DrawNoise();
}

Pose2 PoseError::Told(const Pose2& truth) const { return Sum(truth, drift_, noise_); }

Pose2 PoseError::TrueFor(const Pose2& told) const {
  return Sum(told, {-drift_.x_m, -drift_.y_m, -drift_.yaw_rad}, {});
}

void PoseError::DrawNoise() {
  if (options_ == PoseErrorOptions{}) return;
  noise_ = {options_.position_sigma_m * rng_.Gaussian(),
            options_.position_sigma_m * rng_.Gaussian(), options_.yaw_sigma_rad * rng_.Gaussian()};
}

}  // namespace plumescout::lab
