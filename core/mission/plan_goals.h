// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/types/plan.h"

namespace plumescout {

// Of the goals of a plan, what a fleet remembers.

// Where its trajectory ends; none if the robot is to stay.
std::optional<Goal> ChosenGoal(const Plan& plan);

inline bool MakesWay(const std::optional<Goal>& goal) {
  return goal && goal->kind == GoalKind::kMakeWay;
}

// The goal that others must not be sent to meanwhile. There is room for all at home, and who makes
// way has no errand where it goes.
std::optional<Goal> GoalToClaim(const Plan& plan);

// Where a robot that is to stay, or to make way, would go if others were not in the way.
std::optional<Goal> WantedGoal(const Plan& plan);

}  // namespace plumescout
