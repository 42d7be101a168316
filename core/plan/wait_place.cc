// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/wait_place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "core/plan/blockade.h"
#include "core/plan/right_of_way.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

// A way on which the robot stands, and how far from it another robot keeps.
struct WayOfOther {
  std::vector<Point2> points;
  double apart_m = 0.0;
};

// The robots as they are when this one stands there, for whatever comes.
std::map<RobotId, RobotRecord> RobotsWith(const Belief& belief, const RobotId& robot,
                                          const Pose2& pose) {
  std::map<RobotId, RobotRecord> robots = belief.robots;
  RobotRecord& own = robots.at(robot);
  own.state.has_pose = true;
  own.state.silent = false;
  own.state.pose = pose;
  own.live_trajectory = nullptr;
  own.wanted_goal.reset();
  return robots;
}

// Those whom it is in the way of there.
std::vector<BlockedRobot> BlockedFrom(const Belief& belief, const PlanningOptions& options,
                                      const RobotId& robot, const Pose2& pose) {
  std::vector<BlockedRobot> blocked =
      FindBlockedRobots(belief, RobotsWith(belief, robot, pose), options);
  std::erase_if(blocked, [&](const BlockedRobot& other) {
    return std::count(other.by.begin(), other.by.end(), robot) == 0;
  });
  return blocked;
}

// Of those whom the robot is in the way of where its trajectory begins.
std::vector<WayOfOther> WaysBlockedBy(const Belief& belief, const PlanningOptions& options,
                                      const Plan& plan) {
  const Pose2& start = plan.trajectory.waypoints.front().pose;
  RobotState own = belief.robots.at(plan.robot).state;
  own.pose = start;
  const double half_diagonal_m = belief.geometry().resolution_m / std::sqrt(2.0);
  std::vector<WayOfOther> ways;
  for (BlockedRobot& other : BlockedFrom(belief, options, plan.robot, start)) {
    const double apart_m =
        Apart_m(own, belief.robots.at(other.robot).state, options.robot_clearance_m);
    ways.push_back({std::move(other.way), apart_m + half_diagonal_m});
  }
  return ways;
}

bool IsOff(Point2 place, const std::vector<WayOfOther>& ways) {
  return std::all_of(ways.begin(), ways.end(), [&](const WayOfOther& way) {
    return std::all_of(way.points.begin(), way.points.end(),
                       [&](Point2 point) { return Distance_m(point, place) >= way.apart_m; });
  });
}

Trajectory WithWaitAt(std::size_t stop, Trajectory trajectory) {
  const double wait_s = std::exchange(trajectory.waypoints.front().dwell_s, 0.0);
  for (std::size_t i = 1; i <= stop; ++i) trajectory.waypoints[i].arrival_time_s -= wait_s;
  trajectory.waypoints[stop].dwell_s += wait_s;
  return trajectory;
}

}  // namespace

bool WaitOutOfTheWay(const Belief& belief, const PlanningOptions& options, Plan& plan) {
  const bool waits = options.yield_to_robots && options.dwell_s == 0.0 && plan.chosen >= 0 &&
                     WaitOf_s(plan.trajectory) > 0.0;
  if (!waits || belief.robots.size() < 2) return false;
  const std::vector<WayOfOther> ways = WaysBlockedBy(belief, options, plan);
  if (ways.empty()) return false;
  const Traffic traffic = TrafficFor(belief, plan, options);
  const std::vector<Waypoint>& waypoints = plan.trajectory.waypoints;
  for (std::size_t stop = waypoints.size() - 1; stop-- > 1;) {
    const Waypoint& waypoint = waypoints[stop];
    if (waypoint.speed_mps != 0.0 || !IsOff(waypoint.pose.position(), ways)) continue;
    Trajectory moved = WithWaitAt(stop, plan.trajectory);
    if (traffic.FirstMeeting(moved)) continue;
    if (!BlockedFrom(belief, options, plan.robot, waypoint.pose).empty()) continue;
    plan.trajectory = std::move(moved);
    return true;
  }
  return false;
}

}  // namespace plumescout
