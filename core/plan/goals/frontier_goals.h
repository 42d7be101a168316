// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/plan/goals/goal_offer.h"
#include "core/types/frontier.h"

namespace plumescout {

// A frontier that may be driven to.
struct OfferedGoal {
  Goal goal;
  double travel_m = 0.0;  // on the 8-connected grid
};

// The exploration-rich goal set of [XIT] Eq. (2), and what was left out of it.
struct FrontierGoals {
  std::vector<OfferedGoal> gas;
  std::vector<OfferedGoal> occupancy;
  std::vector<RejectedGoal> rejected;
};

// Finds frontiers from query.start and judges each: too small, kept out (all its
// cells in keep-out areas), unreachable, set aside (SamePlace of
// core/belief/belief.h), claimed by another robot (IsSameErrand, or a gas
// frontier that query.ahead has observed), or too close, in this order; the
// rest are offered. The goal of a gas frontier is one of its own cells, for only a reading taken
// there resolves it; one without a cell to stand on is unreachable. Gas frontiers are not sought
// under GoalPolicy::kOccupancyOnly. Those of gas come first.
std::vector<JudgedFrontier> JudgeFrontiers(const GoalQuery& query);

// The same, sorted by what may become of them.
FrontierGoals FindFrontierGoals(const GoalQuery& query);

// Why this robot must not be sent to `goal` by what other plans and earlier visits say, if so.
std::optional<RejectedGoal> RejectedByMemory(const GoalQuery& query, const Goal& goal);

}  // namespace plumescout
