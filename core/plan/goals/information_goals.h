// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/plan/goals/goal_offer.h"
#include "core/plan/goals/own_area.h"
#include "core/types/plan.h"

namespace plumescout {

// Where gas readings are expected to tell much (ours): frontiers are gone as soon as the gas is
// known roughly, and these say where it pays to measure again. What a cell can still tell is
//
//   relevance * max(0, 1/2 ln(epsilon / epsilon_done))
//
// with the prior's epsilon_inf as the most, and epsilon_done between the variance at which clean
// air counts as observed and half of that where there surely is gas: without an end to it no
// mission would end. Summed over a window of 1 m and divided by the way there, lengthened by the
// length of an average errand, that ranks places; the best are taken that are not too near to each
// other or nearer than one reading to the robot. The cell itself must have something left to tell:
// it is where the reading is taken, so every visit brings the end nearer, which it would not for
// the sake of cells beyond a wall. Places of this kind that are set aside, and those that
// other robots are on their way to for whatever there is to learn, keep goals at the same distance,
// and are added to `rejected` if that leaves any out. None before the first reading, and none off
// `area`, if there is one. Deterministic. Cost: O(cells).
std::vector<Goal> InformationGoals(const GoalQuery& query, std::vector<RejectedGoal>& rejected,
                                   const OwnArea* area = nullptr);

}  // namespace plumescout
