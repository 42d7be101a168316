// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/paths/path_planner.h"
#include "core/types/options.h"

namespace plumescout {

struct RegionTreeOptions {
  PathKind kind = PathKind::kRrt;  // or kRrtStar
  double step_m = 1.0;             // longest edge, > 0
  double goal_radius_m = 0.5;      // of the disc around each goal where paths may end, > 0
  int max_samples = 10'000;        // states drawn before the search gives up, >= 0
};

// One tree towards all goals at once: OMPL's RRT or RRT*, grown until it has a vertex in the disc
// of every goal. Each path leads to the vertex of its disc that is the cheapest to reach, so it may
// end beside the goal. The bias of the draws, OMPL's 5 %, is towards goals not reached yet.
// Sets OMPL's seed and console output: one call at a time. REQUIRES: valid options.
PathResult GrowRegionTree(const RegionTreeOptions& options, const PathProblem& problem) noexcept;

}  // namespace plumescout
