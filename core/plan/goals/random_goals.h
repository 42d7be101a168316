// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/plan/goals/goal_set.h"
#include "core/types/plan.h"
#include "core/types/rng.h"

namespace plumescout {

// Fallback of [XIT] section VII: up to options.max_goals different cells drawn uniformly from
// those that the robot can reach, at least min_goal_distance_m away in a straight line and not
// claimed by another robot or set aside. Fewer if there are no more. Cost: O(cells).
std::vector<Goal> RandomGoals(const GoalQuery& query, Rng& rng);

}  // namespace plumescout
