// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/way_left.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/plan/cost/edge_cost.h"
#include "core/plan/goals/travel_budget.h"
#include "core/plan/plan_start.h"
#include "core/plan/selection/candidate_terms.h"
#include "core/plan/selection/choice.h"
#include "core/plan/trajectory_check.h"
#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

// Farther than this from its way a robot does not begin on it.
constexpr double kOnWay_m = 0.1;

struct WayLeft {
  std::vector<Point2> path;
  double wait_s = 0.0;  // of its stop where it stands
};

bool StandsAt(const Trajectory& way, double time_s) {
  return std::any_of(way.waypoints.begin(), way.waypoints.end(), [time_s](const Waypoint& stop) {
    return stop.arrival_time_s <= time_s && time_s < stop.arrival_time_s + stop.dwell_s;
  });
}

// From `start` to the end of the robot's live plan; none if it does not follow one from there, or
// is to stop farther on.
std::optional<WayLeft> FindWayLeft(const RobotRecord& robot, Point2 start, std::int64_t now_ns) {
  if (robot.live_trajectory == nullptr || !robot.live_goal || !robot.state.has_pose ||
      !IsOnItsWay(robot, now_ns)) {
    return std::nullopt;
  }
  const std::optional<NearestTime> nearest =
      FindOnWay(*robot.live_trajectory, start, robot.live_gone_s);
  if (!nearest || !(nearest->distance_m <= kOnWay_m)) return std::nullopt;
  // Who is on the move may begin farther on than it is, when it will have its plan. Who stands by
  // plan leaves at the plan's time, and may know its place but nearly.
  const double gone_s = Progress_s(robot, now_ns);
  const Point2 place = PoseAt(*robot.live_trajectory, gone_s).position();
  const bool stands =
      StandsAt(*robot.live_trajectory, gone_s) && Distance_m(place, start) <= kOnWay_m;
  const double begin_s = stands || place == start ? gone_s : std::max(gone_s, nearest->time_s);
  WayLeft left{{start}, 0.0};
  for (const Waypoint& waypoint : robot.live_trajectory->waypoints) {
    const double until_s = waypoint.arrival_time_s + waypoint.dwell_s;
    if (until_s <= begin_s) continue;
    const bool stands_there = waypoint.arrival_time_s <= begin_s;
    if (stands_there) {
      left.wait_s = until_s - begin_s;
    } else if (waypoint.dwell_s > 0.0) {
      return std::nullopt;
    } else {
      left.path.push_back(waypoint.pose.position());
    }
  }
  if (left.path.size() < 2) return std::nullopt;
  return left;
}

// The first vertex that is not in the inflated zone around obstacles.
std::vector<Point2>::const_iterator FindOut(const Belief& belief, const std::vector<Point2>& path) {
  return std::find_if(path.begin(), path.end(), [&belief](Point2 vertex) {
    return belief.traversable->At(belief.geometry().CellAt(vertex), 0) != 0;
  });
}

}  // namespace

void GoOnOnWayLeft(const SearchedWays& ways, Waits& waits, Plan& plan) {
  const auto& [query, departure, problem, judge] = ways;
  const bool priced = query.options.selection_rule == SelectionRule::kInformationRate;
  const bool from_margin = !departure.way_out.empty();
  // The way out of the margin has no cost.
  if (query.go_home || (from_margin && !priced)) return;
  const std::int64_t now_ns = query.belief.sample_time_ns;
  const Point2 start = from_margin ? departure.way_out.front() : departure.start;
  const std::optional<WayLeft> left = FindWayLeft(query.robot, start, now_ns);
  if (!left || (from_margin && FindBlockage(query.belief, left->path))) return;
  const auto out = from_margin ? FindOut(query.belief, left->path) : left->path.begin();
  const std::vector<Point2> rest(out, left->path.end());
  if (!std::isfinite(PathCost(problem.cost, rest))) return;
  const int covered = UnderWayTo(plan.candidates, query.belief, plan.robot);
  const auto index = static_cast<std::size_t>(covered);
  if (covered >= 0 && waits.waits_s[index] && *waits.waits_s[index] <= left->wait_s) return;
  // By cost alone a way that leads to nothing any more may look best.
  if (covered < 0 && !priced) return;

  Trajectory trajectory = TimeTrajectory(left->path, departure.yaw_rad, query.options);
  const double duration_s = trajectory.duration_s;
  WaitAtStart(left->wait_s, trajectory);
  const Traffic on_time(query.belief.robots, plan.robot,
                        std::min(kCommittedClearance_m, query.options.robot_clearance_m), now_ns,
                        Traffic::Others::kOnTime);
  if (on_time.FirstMeeting(trajectory)) return;

  const Goal goal = covered >= 0 ? plan.candidates[index].goal : *query.robot.live_goal;
  Candidate candidate = MakeCandidate(goal, rest, PathSource::kTree, judge);
  PutBefore({left->path.begin(), out}, candidate);
  candidate.duration_s = duration_s;
  Plan affordable;
  affordable.candidates = {candidate};
  RejectOverBudget(query, affordable);
  if (affordable.candidates.empty()) return;
  if (covered >= 0) {
    plan.candidates[index] = std::move(candidate);
    waits.waits_s[index] = left->wait_s;
  } else {
    candidate.unseen_share = 0.0;
    plan.candidates.push_back(std::move(candidate));
    waits.waits_s.emplace_back(left->wait_s);
  }
}

double ReplanAfter_s(const Belief& belief, const PlanningOptions& options, const Plan& plan) {
  const bool learns = plan.chosen >= 0 && plan.phase != MissionPhase::kReturning &&
                      options.selection_rule == SelectionRule::kInformationRate &&
                      options.dwell_s == 0.0;
  const bool has_company =
      std::any_of(belief.robots.begin(), belief.robots.end(), [&](const auto& other) {
        const auto& [id, record] = other;
        return id != plan.robot && record.state.has_pose && !record.state.silent;
      });
  return learns && has_company ? options.team_replan_period_s : 0.0;
}

}  // namespace plumescout
