// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/team/assigned_plan.h"

#include <utility>
#include <vector>

#include "core/plan/trajectory_check.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

Candidate CandidateOf(const Goal& goal, const Trajectory& trajectory) {
  Candidate candidate;
  candidate.goal = goal;
  candidate.path_source = PathSource::kGridSearch;
  candidate.length_m = trajectory.length_m;
  candidate.cost = trajectory.length_m;
  candidate.duration_s = trajectory.duration_s;
  for (const Waypoint& waypoint : trajectory.waypoints) {
    const Point2 place = waypoint.pose.position();
    candidate.path.push_back(place);
    if (goal.kind == GoalKind::kSite && waypoint.dwell_s > 0.0) candidate.stops.push_back(place);
  }
  return candidate;
}

// Whether others still reckon with its way, and that is open; without a map nothing is known.
bool MayStillBeDriven(const Belief& belief, RobotRecord record, const Pose2& start) {
  record.state.pose = start;
  std::vector<Point2> way;
  for (const Waypoint& waypoint : record.live_trajectory->waypoints) {
    way.push_back(waypoint.pose.position());
  }
  const bool is_open = belief.geometry().size() == 0 || !FindBlockage(belief, way);
  return is_open && IsOnItsWay(record, belief.sample_time_ns);
}

}  // namespace

std::optional<Plan> AssignedPlan(const Belief& belief, const PlanRequest& request) {
  const auto found = belief.robots.find(request.robot);
  if (found == belief.robots.end()) return std::nullopt;
  const RobotRecord& record = found->second;
  const bool assigned = record.assigned_plan != 0 && record.live_goal &&
                        record.live_trajectory != nullptr &&
                        !record.live_trajectory->waypoints.empty();
  const bool go_home = request.go_home || IsSentHome(record);
  if (!assigned || (go_home && record.live_goal->kind != GoalKind::kHome)) {
    return std::nullopt;
  }
  if (!request.start && !record.state.has_pose) return std::nullopt;
  const Pose2& start = request.start ? *request.start : record.state.pose;
  const Point2 first = record.live_trajectory->waypoints.front().pose.position();
  const bool is_there = Distance_m(start.position(), first) <= kAssignedStart_m;
  if (!is_there || !MayStillBeDriven(belief, record, start)) return std::nullopt;
  Plan plan;
  plan.id = record.assigned_plan;
  plan.robot = request.robot;
  plan.strategy = belief.options->planning.strategy;
  plan.belief_revision = belief.revision;
  plan.phase = PhaseToward(record.live_goal->kind);
  plan.end = PlanEnd::kAllGoalsReached;
  plan.chosen = 0;
  plan.trajectory = *record.live_trajectory;
  plan.candidates = {CandidateOf(*record.live_goal, plan.trajectory)};
  plan.explanation = "As it was planned for the team.";
  return plan;
}

}  // namespace plumescout
