// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/plan_goals.h"

#include <algorithm>
#include <cstddef>

namespace plumescout {

std::optional<Goal> ChosenGoal(const Plan& plan) {
  if (plan.chosen < 0 || plan.chosen >= static_cast<int>(plan.candidates.size())) {
    return std::nullopt;
  }
  return plan.candidates[static_cast<std::size_t>(plan.chosen)].goal;
}

std::optional<Goal> GoalToClaim(const Plan& plan) {
  const std::optional<Goal> goal = ChosenGoal(plan);
  return goal && goal->kind != GoalKind::kHome && !MakesWay(goal) ? goal : std::nullopt;
}

std::optional<Goal> WantedGoal(const Plan& plan) {
  if (plan.chosen >= 0 && !MakesWay(ChosenGoal(plan))) return std::nullopt;
  const auto wanted = std::find_if(
      plan.rejected.begin(), plan.rejected.end(),
      [](const RejectedGoal& goal) { return goal.reason == RejectionReason::kTraffic; });
  return wanted == plan.rejected.end() ? std::nullopt : std::optional<Goal>(wanted->goal);
}

}  // namespace plumescout
