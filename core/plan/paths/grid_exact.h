// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/paths/path_planner.h"

namespace plumescout {

// Ours: one exact search of the 8-connected grid to all goals at once, each way then straightened.
// Reaches every goal that has a traversable way, without samples or chance: the seed has no effect.
//
// The edge budget bounds the straightening, not the search.
// Cost: O(cells cheaper to reach than the dearest goal) and some thousand edge integrals a goal.
class GridExactPlanner : public PathPlanner {
 public:
  PathResult FindPaths(const PathProblem& problem) const override;
};

}  // namespace plumescout
