// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/grid_exact.h"

#include "core/plan/paths/grid_guard.h"

namespace plumescout {

PathResult GridExactPlanner::FindPaths(const PathProblem& problem) const {
  PathResult result;
  result.paths.resize(problem.goals.size());
  CompleteOnGrid(problem, PathSource::kGridSearch, result);
  return result;
}

}  // namespace plumescout
