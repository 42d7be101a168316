// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/observation.h"
#include "core/types/pose2.h"

namespace plumescout::lab {

// A localisation that drifts and now and then comes to a place that it knows: then it knows where
// it was all the way since the last time, at keyframes a second apart.
class LoopClosure {
 public:
  // None: never.
  explicit LoopClosure(std::optional<double> every_s)
      : every_s_(every_s), closes_at_s_(every_s.value_or(0.0)) {}

  // It is `elapsed_s` after the start, `now_ns` by the robot's clock, and the robot is at `truth`.
  // Returns whether it finds out now. Times do not fall.
  bool Pass(double elapsed_s, std::int64_t now_ns, const Pose2& truth);

  // Once: where the robot was at the keyframes since the last correction that was taken.
  std::optional<PoseCorrection> TakeCorrection();

 private:
  std::optional<double> every_s_;
  double closes_at_s_;
  double next_keyframe_s_ = 0.0;
  std::vector<PoseAnchor> keyframes_;
  std::optional<PoseCorrection> correction_;
};

}  // namespace plumescout::lab
