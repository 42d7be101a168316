// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/belief/belief.h"
#include "core/plan/departure.h"
#include "core/plan/paths/path_planner.h"
#include "core/plan/selection/candidate_terms.h"
#include "core/types/options.h"
#include "core/types/plan.h"

namespace plumescout {

// What a search was asked that found the candidates of a plan, and what these are judged by.
struct SearchedWays {
  const Belief& belief;
  const Departure& departure;
  const PathProblem& problem;
  const CandidateJudge& judge;
  const PlanningOptions& options;
};

// Candidates whose ways meet other robots, so that they would have to stand for kWorthAWayRound_s
// or more or could not be gone at all, get a way that keeps off wherever those robots will be, if
// with its own wait it is the sooner end. Like that robots pass each other in a room, or take
// another door. Nothing if options.yield_to_robots is false. REQUIRES: duration_s of all
// candidates, without waits. Cost: that of Traffic::LeastWait_s for each candidate; if one is to
// stand, a search of the grid (see GridExactPlanner).
inline constexpr double kWorthAWayRound_s = 1.0;
void LeadRound(const SearchedWays& ways, Plan& plan);

}  // namespace plumescout
