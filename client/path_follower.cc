// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/path_follower.h"

#include <algorithm>
#include <cmath>

namespace plumescout::client {
namespace {

double DepartureTime_s(const Waypoint& waypoint) {
  return waypoint.arrival_time_s + waypoint.dwell_s;
}

}  // namespace

PathFollower::PathFollower(const Trajectory& trajectory, const FollowerOptions& options)
    : trajectory_(trajectory), options_(options) {}

Twist PathFollower::Step(const Pose2& pose, std::int64_t now_ns) {
  PassReachedWaypoints(pose, now_ns);
  if (done() || Dwelling(now_ns)) return {};
  return Towards(trajectory_.waypoints[next_].pose.position(), pose);
}

std::vector<Point2> PathFollower::PathAhead(Point2 from) const {
  std::vector<Point2> path = {from};
  for (std::size_t i = next_; i < trajectory_.waypoints.size(); ++i) {
    path.push_back(trajectory_.waypoints[i].pose.position());
  }
  return path;
}

void PathFollower::PassReachedWaypoints(const Pose2& pose, std::int64_t now_ns) {
  constexpr double kNanosecondsPerSecond = 1e9;
  while (!done() && !Dwelling(now_ns)) {
    if (dwell_until_ns_ > 0) {  // the dwell at this waypoint is over
      dwell_until_ns_ = 0;
      ++next_;
      continue;
    }
    const Waypoint& waypoint = trajectory_.waypoints[next_];
    const double distance_m = Distance_m(pose.position(), waypoint.pose.position());
    const bool is_start = next_ == 0;  // reached by definition
    if (!is_start && distance_m > options_.arrival_tolerance_m) break;
    if (waypoint.dwell_s > 0.0) {
      dwell_until_ns_ = now_ns + std::llround(waypoint.dwell_s * kNanosecondsPerSecond);
    } else {
      ++next_;
    }
  }
}

// REQUIRES: the start is passed.
double PathFollower::PlannedSpeed_mps() const {
  const Waypoint& from = trajectory_.waypoints[next_ - 1];
  const Waypoint& to = trajectory_.waypoints[next_];
  const double duration_s = to.arrival_time_s - DepartureTime_s(from);
  if (!(duration_s > 0.0)) return options_.max_forward_mps;
  const double speed_mps = Distance_m(from.pose.position(), to.pose.position()) / duration_s;
  return std::min(speed_mps, options_.max_forward_mps);
}

Twist PathFollower::Towards(Point2 target, const Pose2& pose) const {
  const double bearing_rad = std::atan2(target.y_m - pose.y_m, target.x_m - pose.x_m);
  const double error_rad = WrapAngle_rad(bearing_rad - pose.yaw_rad);
  const double turn_rad_per_s =
      std::clamp(options_.turn_gain_per_s * error_rad, -options_.max_turn_rad_per_s,
                 options_.max_turn_rad_per_s);
  const double fade = std::max(0.0, 1.0 - std::abs(error_rad) / options_.stop_heading_error_rad);
  const double no_overshoot_mps = Distance_m(pose.position(), target) / options_.tick_s;
  return {.forward_mps = std::min(PlannedSpeed_mps() * fade, no_overshoot_mps),
          .turn_rad_per_s = turn_rad_per_s};
}

}  // namespace plumescout::client
