// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "client/ros2/transform.h"
#include "core/types/observation.h"

namespace plumescout::client {

struct FrameJumpOptions {
  double distance_m = 0.3;  // map → odom moved by more than this at once, > 0
  double angle_rad = 0.2;   // or turned by more than this, > 0
  // What was wrong grew from the last jump on, as drift does that a loop closure finds; else the
  // whole way since then was off by all of it, as after a relocalisation.
  bool is_drift = true;
};

// Finds out that SLAM moved its frame, and what that says of the way since it last did.
class FrameJump {
 public:
  explicit FrameJump(const FrameJumpOptions& options) : options_(options) {}

  // Something was sensed there, and handed on so: where its sensor was in odom, and in map.
  void NoteSensed(std::int64_t time_ns, const Transform& in_odom, const Transform& in_map);
  // map → odom is another one now.
  void Move(const Transform& before, const Transform& now);
  // Once for each jump.
  std::optional<PoseCorrection> Take();

  std::int64_t jumps() const { return jumps_; }

 private:
  struct Sensed {
    std::int64_t time_ns = 0;
    Transform in_odom;
    Transform in_map;
  };

  const FrameJumpOptions options_;
  std::deque<Sensed> way_;  // since the last jump, by time
  std::optional<PoseCorrection> correction_;
  std::int64_t jumps_ = 0;
};

}  // namespace plumescout::client
