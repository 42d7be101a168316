// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/team/team_belief.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>

namespace plumescout {
namespace {

void EndPlan(const RobotId& robot, Belief& belief) {
  RobotRecord& record = belief.robots.at(robot);
  record.live_trajectory = nullptr;
  record.live_goal.reset();
  record.live_arrival_ns = 0;
  record.live_gone_s = 0.0;
  record.assigned_plan = 0;
  belief.claims.erase(std::remove_if(belief.claims.begin(), belief.claims.end(),
                                     [&](const GoalClaim& claim) { return claim.robot == robot; }),
                      belief.claims.end());
}

}  // namespace

Belief WithPlan(const Belief& belief, const Plan& plan) {
  Belief changed = belief;
  EndPlan(plan.robot, changed);
  RobotRecord& record = changed.robots.at(plan.robot);
  record.wanted_goal.reset();
  if (plan.chosen < 0) return changed;
  const Goal& goal = plan.candidates[static_cast<std::size_t>(plan.chosen)].goal;
  record.live_trajectory = std::make_shared<const Trajectory>(plan.trajectory);
  record.live_goal = goal;
  record.live_arrival_ns = belief.sample_time_ns + std::llround(plan.trajectory.duration_s * 1e9);
  if (goal.kind != GoalKind::kHome && goal.kind != GoalKind::kMakeWay) {
    changed.claims.push_back({plan.robot, plan.id, goal, std::numeric_limits<std::int64_t>::max()});
  }
  return changed;
}

Belief WithoutPlans(const Belief& belief, const std::vector<RobotId>& robots) {
  Belief changed = belief;
  for (const RobotId& robot : robots) {
    if (changed.robots.contains(robot)) EndPlan(robot, changed);
  }
  return changed;
}

std::vector<RobotId> FreeRobots(const Belief& belief) {
  std::vector<RobotId> robots;
  for (const auto& [id, record] : belief.robots) {
    const bool here = record.state.has_pose && !record.state.silent;
    if (here && record.live_trajectory == nullptr) robots.push_back(id);
  }
  return robots;
}

}  // namespace plumescout
