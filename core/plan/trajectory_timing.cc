// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/trajectory_timing.h"

#include <cmath>

namespace plumescout {

Trajectory TimeTrajectory(const std::vector<Point2>& path, double start_yaw_rad, double speed_mps,
                          double dwell_s) {
  Trajectory trajectory;
  if (path.empty()) return trajectory;
  std::vector<Waypoint>& waypoints = trajectory.waypoints;
  waypoints.push_back({{path.front().x_m, path.front().y_m, start_yaw_rad}, 0.0, 0.0});
  for (const Point2 point : path) {
    Waypoint& last = waypoints.back();
    const double leg_m = Distance_m(last.pose.position(), point);
    if (leg_m == 0.0) continue;
    last.pose.yaw_rad =
        WrapAngle_rad(std::atan2(point.y_m - last.pose.y_m, point.x_m - last.pose.x_m));
    trajectory.length_m += leg_m;
    waypoints.push_back({{point.x_m, point.y_m, last.pose.yaw_rad},
                         last.arrival_time_s + last.dwell_s + leg_m / speed_mps,
                         dwell_s});
  }
  trajectory.duration_s = waypoints.back().arrival_time_s + waypoints.back().dwell_s;
  return trajectory;
}

}  // namespace plumescout
