// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/way_correction.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace plumescout {
namespace {

Pose2 Between(const Pose2& from, const Pose2& to, double share) {
  return {std::lerp(from.x_m, to.x_m, share), std::lerp(from.y_m, to.y_m, share),
          WrapAngle_rad(from.yaw_rad + share * WrapAngle_rad(to.yaw_rad - from.yaw_rad))};
}

double ShareOf(std::int64_t time_ns, std::int64_t from_ns, std::int64_t to_ns) {
  return static_cast<double>(time_ns - from_ns) / static_cast<double>(to_ns - from_ns);
}

template <typename Element>
auto FirstAfter(const std::vector<Element>& elements, std::int64_t time_ns) {
  return std::partition_point(elements.begin(), elements.end(), [time_ns](const Element& element) {
    return element.time_ns <= time_ns;
  });
}

}  // namespace

Pose2 PoseOnWay(const std::vector<WayPoint>& way, std::int64_t time_ns) {
  const auto after = FirstAfter(way, time_ns);
  if (after == way.begin()) return way.front().pose;
  const auto before = std::prev(after);
  if (after == way.end() || before->time_ns == time_ns) return before->pose;
  return Between(before->pose, after->pose, ShareOf(time_ns, before->time_ns, after->time_ns));
}

WayCorrection::WayCorrection(const std::vector<WayPoint>& way,
                             const std::vector<PoseAnchor>& anchors) {
  moves_.reserve(anchors.size());
  for (const PoseAnchor& anchor : anchors) {
    moves_.push_back({anchor.sample_time_ns, PoseOnWay(way, anchor.sample_time_ns), anchor.pose});
  }
}

Pose2 WayCorrection::Move::Of(const Pose2& pose) const {
  return Compose(right, Compose(Inverse(held), pose));
}

Pose2 WayCorrection::Corrected(std::int64_t time_ns, const Pose2& pose) const {
  const auto after = FirstAfter(moves_, time_ns);
  if (after == moves_.begin()) return moves_.front().Of(pose);
  const auto before = std::prev(after);
  if (after == moves_.end()) return before->Of(pose);
  return Between(before->Of(pose), after->Of(pose),
                 ShareOf(time_ns, before->time_ns, after->time_ns));
}

}  // namespace plumescout
