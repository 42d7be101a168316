// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/pose_jump.h"

#include <utility>

#include "core/types/checker.h"

namespace plumescout::lab {
namespace {

constexpr double kMostTime_s = 1e6;
constexpr double kMostStep_m = 100.0;
constexpr double kMostTurn_rad = 3.2;

}  // namespace

absl::Status Validate(const PoseJumpOptions& options) {
  return Checker()
      .InRange("pose_error.jump.at_s", options.at_s, 0.0, kMostTime_s)
      .InRange("pose_error.jump.east_m", options.east_m, -kMostStep_m, kMostStep_m)
      .InRange("pose_error.jump.north_m", options.north_m, -kMostStep_m, kMostStep_m)
      .InRange("pose_error.jump.turn_rad", options.turn_rad, -kMostTurn_rad, kMostTurn_rad)
      .InRange("pose_error.jump.corrected_after_s", options.corrected_after_s.value_or(0.0), 0.0,
               kMostTime_s)
      .status();
}

void PoseJump::Pass(double elapsed_s, std::int64_t now_ns, const Pose2& held) {
  if (!options_ || over_) return;
  if (!jumped_) {
    if (elapsed_s < options_->at_s) {
      before_ = PoseAnchor{now_ns, held};
      return;
    }
    after_ = PoseAnchor{now_ns, held};
    const Pose2 told{held.x_m + options_->east_m, held.y_m + options_->north_m,
                     held.yaw_rad + options_->turn_rad};
    jumped_ = Compose(told, Inverse(held));
    return;
  }
  if (!options_->corrected_after_s) return;
  if (elapsed_s < options_->at_s + *options_->corrected_after_s) return;
  correction_.emplace();
  if (before_) correction_->anchors.push_back(*before_);
  correction_->anchors.push_back(*after_);
  correction_->anchors.push_back({now_ns, held});
  jumped_.reset();
  over_ = true;
}

std::optional<PoseCorrection> PoseJump::TakeCorrection() {
  return std::exchange(correction_, std::nullopt);
}

}  // namespace plumescout::lab
