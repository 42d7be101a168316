// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/departure.h"
#include "core/plan/goals/goal_offer.h"
#include "core/plan/paths/path_planner.h"
#include "core/plan/right_of_way.h"
#include "core/plan/selection/candidate_terms.h"
#include "core/types/plan.h"

namespace plumescout {

// What a search was asked that found the candidates of a plan, and what these are judged by.
struct SearchedWays {
  const GoalQuery& query;
  const Departure& departure;
  const PathProblem& problem;
  const CandidateJudge& judge;
};

// Candidates whose ways meet other robots, so that they would have to stand for kWorthAWayRound_s
// or more or could not be gone at all, get a way within the travel budget that keeps off wherever
// those robots will be, if with its own wait it is the sooner end: robots pass each other in a
// room, or take another door. Where candidates are not compared by their time, only those do that
// could not be gone, and that no clear candidate beats (BeatsByMargin) as they are. What is left of
// the plan's edge evaluations bounds the search, which adds to them. REQUIRES: duration_s of all
// candidates, without waits; `waits` are theirs, and stay so. Cost: if one is to stand, a search of
// the grid (see GridExactPlanner), and Traffic::LeastWait_s for each that was.
inline constexpr double kWorthAWayRound_s = 1.0;
void LeadRound(const SearchedWays& ways, Waits& waits, Plan& plan);

}  // namespace plumescout
