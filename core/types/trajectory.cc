// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/trajectory.h"

#include <algorithm>

namespace plumescout {
namespace {

// The share of the way from `from` to `to` that is behind the robot after a share of the time.
double ShareOfWay(const Waypoint& from, const Waypoint& to, double share_of_time) {
  const double speeds_mps = from.speed_mps + to.speed_mps;
  if (!(speeds_mps > 0.0)) return share_of_time;
  // The integral of a speed that changes evenly, over the same to the end.
  const double growth_mps = to.speed_mps - from.speed_mps;
  return share_of_time * (2.0 * from.speed_mps + growth_mps * share_of_time) / speeds_mps;
}

Pose2 Between(const Waypoint& from, const Waypoint& to, double time_s) {
  const double departure_s = from.arrival_time_s + from.dwell_s;
  const double duration_s = to.arrival_time_s - departure_s;
  const double time_share =
      duration_s > 0.0 ? std::clamp((time_s - departure_s) / duration_s, 0.0, 1.0) : 0.0;
  Pose2 pose = from.pose;
  if (from.pose.position() == to.pose.position()) {
    const double turn_rad = WrapAngle_rad(to.pose.yaw_rad - from.pose.yaw_rad);
    pose.yaw_rad = WrapAngle_rad(from.pose.yaw_rad + time_share * turn_rad);
    return pose;
  }
  const double share = ShareOfWay(from, to, time_share);
  pose.x_m += share * (to.pose.x_m - from.pose.x_m);
  pose.y_m += share * (to.pose.y_m - from.pose.y_m);
  return pose;
}

}  // namespace

Pose2 PoseAt(const Trajectory& trajectory, double time_s) {
  const std::vector<Waypoint>& waypoints = trajectory.waypoints;
  const auto after = std::find_if(waypoints.begin(), waypoints.end(), [time_s](const Waypoint& w) {
    return w.arrival_time_s > time_s;
  });
  if (after == waypoints.begin()) return waypoints.front().pose;
  if (after == waypoints.end()) return waypoints.back().pose;
  return Between(*(after - 1), *after, time_s);
}

}  // namespace plumescout
