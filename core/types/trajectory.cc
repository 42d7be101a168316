// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/trajectory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

// The share of the time that has gone by when the robot is through a share of the way.
double ShareOfTime(const Waypoint& from, const Waypoint& to, double share_of_way) {
  const double speeds_mps = from.speed_mps + to.speed_mps;
  if (!(speeds_mps > 0.0) || share_of_way == 0.0) return share_of_way;
  // The square of the speed changes evenly over the way, and time is length over mean speed.
  const double from_mps2 = from.speed_mps * from.speed_mps;
  const double to_mps2 = to.speed_mps * to.speed_mps;
  const double speed_there_mps = std::sqrt(std::lerp(from_mps2, to_mps2, share_of_way));
  return share_of_way * speeds_mps / (from.speed_mps + speed_there_mps);
}

// The share of the way from `from` to `to` that is behind the robot at `time_s`, [0, 1].
double ShareAt(const Waypoint& from, const Waypoint& to, double time_s) {
  const double departure_s = from.arrival_time_s + from.dwell_s;
  const double duration_s = to.arrival_time_s - departure_s;
  if (!(duration_s > 0.0)) return 0.0;
  return ShareOfWay(from, to, std::clamp((time_s - departure_s) / duration_s, 0.0, 1.0));
}

// The share of the segment at which it is nearest to `place`.
double NearestShare(Point2 from, Point2 to, Point2 place) {
  const double dx_m = to.x_m - from.x_m;
  const double dy_m = to.y_m - from.y_m;
  const double length_m2 = dx_m * dx_m + dy_m * dy_m;
  if (!(length_m2 > 0.0)) return 0.0;
  const double along_m2 = (place.x_m - from.x_m) * dx_m + (place.y_m - from.y_m) * dy_m;
  return std::clamp(along_m2 / length_m2, 0.0, 1.0);
}

// Where a leg is nearest to a place.
struct OnLeg {
  double share = 0.0;  // of the leg, by length
  double distance_m = 0.0;
};

// From `least_share` of it on.
OnLeg NearestOnLeg(const Waypoint& from, const Waypoint& to, Point2 place, double least_share) {
  const double share =
      std::max(least_share, NearestShare(from.pose.position(), to.pose.position(), place));
  const Point2 nearest = {std::lerp(from.pose.x_m, to.pose.x_m, share),
                          std::lerp(from.pose.y_m, to.pose.y_m, share)};
  return {share, Distance_m(nearest, place)};
}

NearestTime Timed(const Waypoint& from, const Waypoint& to, const OnLeg& there) {
  const double departure_s = from.arrival_time_s + from.dwell_s;
  return {std::lerp(departure_s, to.arrival_time_s, ShareOfTime(from, to, there.share)),
          there.distance_m};
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

std::optional<NearestTime> FindNearest(const Trajectory& trajectory, Point2 place) {
  const std::vector<Waypoint>& waypoints = trajectory.waypoints;
  if (waypoints.empty()) return std::nullopt;
  NearestTime best = {waypoints[0].dwell_s, Distance_m(waypoints[0].pose.position(), place)};
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Waypoint& from = waypoints[i - 1];
    const OnLeg there = NearestOnLeg(from, waypoints[i], place, 0.0);
    if (there.distance_m < best.distance_m) best = Timed(from, waypoints[i], there);
  }
  return best;
}

std::optional<NearestTime> FindOnWay(const Trajectory& trajectory, Point2 place, double gone_s) {
  constexpr double kPosesErr_m = 0.15;
  constexpr double kSoon_s = 0.5;  // between two poses
  const std::optional<NearestTime> nearest = FindNearest(trajectory, place);
  if (!nearest) return nearest;
  if (nearest->time_s >= gone_s && nearest->time_s <= gone_s + kSoon_s) return nearest;
  const std::vector<Waypoint>& waypoints = trajectory.waypoints;
  std::optional<NearestTime> first;  // as near, and nearer than just before
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Waypoint& from = waypoints[i - 1];
    const Waypoint& to = waypoints[i];
    if (to.arrival_time_s < gone_s) continue;
    const OnLeg there = NearestOnLeg(from, to, place, ShareAt(from, to, gone_s));
    if (first && there.distance_m >= first->distance_m) break;
    if (there.distance_m > nearest->distance_m + kPosesErr_m) continue;
    first = Timed(from, to, there);
    first->time_s = std::max(gone_s, first->time_s);
    if (there.share < 1.0) break;
  }
  return first ? first : nearest;
}

}  // namespace plumescout
