// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/goal_policy.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace plumescout {
namespace {

// Brings `count` goals drawn at random to the front (Fisher and Yates).
void DrawToFront(std::vector<OfferedGoal>& goals, std::size_t count, Rng& rng) {
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(goals[i], goals[i + rng.Below(goals.size() - i)]);
  }
}

void SortByTravel(std::vector<OfferedGoal>& goals) {
  std::stable_sort(goals.begin(), goals.end(), [](const OfferedGoal& a, const OfferedGoal& b) {
    return a.travel_m < b.travel_m;
  });
}

// Moves the first `count` of `offered` to `chosen`, the rest to `rejected`.
void Take(const std::vector<OfferedGoal>& offered, std::size_t count, std::vector<Goal>& chosen,
          std::vector<RejectedGoal>& rejected) {
  for (std::size_t i = 0; i < offered.size(); ++i) {
    if (i < count) {
      chosen.push_back(offered[i].goal);
    } else {
      rejected.push_back({offered[i].goal, RejectionReason::kNotDrawn, ""});
    }
  }
}

}  // namespace

std::vector<Goal> ChooseByPolicy(FrontierGoals frontiers, const PlanningOptions& options, Rng& rng,
                                 std::vector<RejectedGoal>& rejected) {
  const bool gas_first = options.goal_policy != GoalPolicy::kOccupancyFirst;
  std::vector<OfferedGoal>& first = gas_first ? frontiers.gas : frontiers.occupancy;
  std::vector<OfferedGoal>& second = gas_first ? frontiers.occupancy : frontiers.gas;
  const auto slots = static_cast<std::size_t>(options.max_goal_count);

  const bool everything = options.goal_policy == GoalPolicy::kEverything;
  const bool limited = options.draw_goals || everything;
  const std::size_t from_first = limited ? std::min(first.size(), slots) : first.size();
  const std::size_t free_slots = everything ? slots : slots - std::min(slots, from_first);
  std::size_t from_second = std::min(second.size(), free_slots);
  if (options.draw_goals) {
    DrawToFront(first, from_first, rng);
    DrawToFront(second, from_second, rng);
  } else {
    if (everything) SortByTravel(first);
    SortByTravel(second);
    if (first.empty() && !everything) from_second = second.size();
  }
  std::vector<Goal> chosen;
  Take(first, from_first, chosen, rejected);
  Take(second, from_second, chosen, rejected);
  return chosen;
}

}  // namespace plumescout
