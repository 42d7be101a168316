// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/plan/goals/frontier_goals.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/rng.h"

namespace plumescout {

// The goals that options.goal_policy takes of the offered ones, first kind first; the others are
// added to `rejected` as not drawn. Under GFF the first kind is gas, the second occupancy; under
// FGF the other way round; under F there is no second.
//   draw_goals        [XIT] section VI-B: up to max_goal_count of the first kind, at random if
//   there
//                     are more, and the slots left filled with the second kind at random.
//   not draw_goals    ours: all goals of the first kind, and the slots that these leave free of
//                     max_goal_count filled with the nearest of the second; all of the second if
//                     there is none of the first. A search to more goals costs next to nothing, and
//                     nothing is left to luck.
// Under kEverything (ours) each kind has max_goal_count slots of its own, for the nearest or, with
// draw_goals, at random: what a path tells is priced goal by goal, which does cost something.
std::vector<Goal> ChooseByPolicy(FrontierGoals frontiers, const PlanningOptions& options, Rng& rng,
                                 std::vector<RejectedGoal>& rejected);

}  // namespace plumescout
