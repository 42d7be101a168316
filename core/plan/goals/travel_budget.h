// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/goals/goal_offer.h"
#include "core/types/plan.h"

namespace plumescout {

// Moves the candidates of `plan` that are over the robot's travel budget, or from which it would
// not be home by the mission's deadline, to its rejected goals. Over budget are those whose own
// length and (1 + return_margin_share) times the way home from their end exceed travel_budget_m
// less what the robot has driven. The way home is the shortest by steps between neighbouring cells,
// up to 8 % longer than the shortest there is; from where there is none, every length is too much.
// Nothing is over budget if there is none; home never is. Too late is what takes more time than
// there is until the deadline, with the same margin on both ways, if the way home is driven at the
// mean speed of the way there, or at speed_mps if that is less. The margin is also for what the
// robot drives while it is planned for, which does not count yet. The plan's choice is not looked
// at. Cost: that of query.FromHome().
void RejectOverBudget(const GoalQuery& query, Plan& plan);

// Whether there is a travel budget, or a deadline.
bool IsLimited(const GoalQuery& query);

}  // namespace plumescout
