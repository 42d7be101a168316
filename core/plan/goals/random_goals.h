// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/plan/goals/goal_offer.h"
#include "core/types/plan.h"
#include "core/types/rng.h"

namespace plumescout {

// Fallback goals: up to options.max_goal_count different cells drawn uniformly from a set, of those
// that the robot can reach, at least min_goal_distance_m away in a straight line and not claimed by
// another robot or set aside. Fewer if there are no more. Cost: O(cells).

// From all of free space, [XIT] section VII.
std::vector<Goal> RandomGoals(const GoalQuery& query, Rng& rng);

// From the cells whose gas is unobserved with that of all their neighbours (ours): a plume that no
// path has crossed shows no frontier, and random places find it late or never.
std::vector<Goal> UnobservedGoals(const GoalQuery& query, Rng& rng);

}  // namespace plumescout
