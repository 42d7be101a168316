// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/loop_closure.h"

#include <utility>

namespace plumescout::lab {
namespace {

constexpr double kKeyframePeriod_s = 1.0;
constexpr double kPassRounding_s = 1e-6;

}  // namespace

bool LoopClosure::Pass(double elapsed_s, std::int64_t now_ns, const Pose2& truth) {
  if (!every_s_) return false;
  const bool closes = elapsed_s >= closes_at_s_ - kPassRounding_s;
  if (closes || elapsed_s >= next_keyframe_s_ - kPassRounding_s) {
    keyframes_.push_back({now_ns, truth});
    next_keyframe_s_ = elapsed_s + kKeyframePeriod_s;
  }
  if (!closes) return false;
  // What was not taken yet is told with the rest.
  correction_ = PoseCorrection{keyframes_};
  while (closes_at_s_ <= elapsed_s + kPassRounding_s) closes_at_s_ += *every_s_;
  return true;
}

std::optional<PoseCorrection> LoopClosure::TakeCorrection() {
  if (!correction_) return std::nullopt;
  const std::int64_t closed_ns = correction_->anchors.back().sample_time_ns;
  std::erase_if(keyframes_,
                [closed_ns](const PoseAnchor& at) { return at.sample_time_ns < closed_ns; });
  return std::exchange(correction_, std::nullopt);
}

}  // namespace plumescout::lab
