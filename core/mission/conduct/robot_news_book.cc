// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/robot_news_book.h"

#include <variant>

namespace plumescout {

void RobotNewsBook::Follow(const Belief& belief) {
  std::erase_if(entries_, [&](const auto& entry) { return belief.robots.count(entry.first) == 0; });
  for (const auto& [robot, record] : belief.robots) {
    Entry& entry = entries_[robot];
    entry.standing = {.ordered_home = record.state.ordered_home,
                      .frame_suspect = record.state.frame_suspect,
                      .silent = record.state.silent};
    PlanNews& plan = entry.plan;
    if (plan.invalidated && plan.invalidated->plan != record.last_plan) plan.invalidated.reset();
    if (plan.assigned && plan.assigned->plan != record.last_plan) plan.assigned.reset();
  }
}

void RobotNewsBook::Note(const RobotId& robot, const RobotNotice& notice) {
  PlanNews& plan = entries_[robot].plan;
  if (const auto* invalidated = std::get_if<PlanInvalidated>(&notice)) {
    plan.invalidated = *invalidated;
  }
  if (const auto* assigned = std::get_if<PlanAssigned>(&notice)) plan.assigned = *assigned;
}

RobotStanding RobotNewsBook::StandingOf(const RobotId& robot) const {
  const auto found = entries_.find(robot);
  return found == entries_.end() ? RobotStanding() : found->second.standing;
}

PlanNews RobotNewsBook::PlanNewsOf(const RobotId& robot) const {
  const auto found = entries_.find(robot);
  return found == entries_.end() ? PlanNews() : found->second.plan;
}

}  // namespace plumescout
