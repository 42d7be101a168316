// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/frame_jump.h"

#include <cmath>
#include <utility>

namespace plumescout::client {
namespace {

constexpr std::size_t kMostAnchors = 256;

}  // namespace

void FrameJump::NoteSensed(std::int64_t time_ns, const Transform& in_odom,
                           const Transform& in_map) {
  if (!way_.empty() && time_ns <= way_.back().time_ns) {
    if (time_ns == way_.back().time_ns) return;
    way_.clear();  // the clock was set back
  }
  way_.push_back({time_ns, in_odom, in_map});
  if (way_.size() <= kMostAnchors) return;
  // A long way is known by every other place; the first and the last stay.
  std::deque<Sensed> thinned;
  for (std::size_t i = 0; i < way_.size(); i += 2) thinned.push_back(way_[i]);
  if (way_.size() % 2 == 0) thinned.push_back(way_.back());
  way_ = std::move(thinned);
}

void FrameJump::Move(const Transform& before, const Transform& now) {
  const Pose2 moved = ToPlanar(Compose(Inverse(before), now));
  const bool jumped = std::hypot(moved.x_m, moved.y_m) > options_.distance_m ||
                      std::abs(moved.yaw_rad) > options_.angle_rad;
  if (!jumped) return;
  ++jumps_;
  if (way_.empty()) return;
  const double span_ns = static_cast<double>(way_.back().time_ns - way_.front().time_ns);
  PoseCorrection correction;
  for (Sensed& sensed : way_) {
    const double since_ns = static_cast<double>(sensed.time_ns - way_.front().time_ns);
    const double share = options_.is_drift && span_ns > 0.0 ? since_ns / span_ns : 1.0;
    sensed.in_map = Interpolate(sensed.in_map, Compose(now, sensed.in_odom), share);
    correction.anchors.push_back({sensed.time_ns, ToPlanar(sensed.in_map)});
  }
  way_.erase(way_.begin(), std::prev(way_.end()));
  // One that nobody has taken yet is of the way before; what lies beyond moves rigidly.
  if (correction_) {
    correction_->anchors.pop_back();
    correction.anchors.insert(correction.anchors.begin(), correction_->anchors.begin(),
                              correction_->anchors.end());
  }
  correction_ = std::move(correction);
}

std::optional<PoseCorrection> FrameJump::Take() { return std::exchange(correction_, std::nullopt); }

}  // namespace plumescout::client
