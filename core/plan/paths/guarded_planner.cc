// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/guarded_planner.h"

#include "core/plan/paths/grid_guard.h"
#include "core/plan/paths/straighten.h"

namespace plumescout {

PathResult GuardedPlanner::FindPaths(const PathProblem& problem) const {
  PathResult result = planner_->FindPaths(problem);
  if (straighten_) {
    EdgePrices prices(problem.cost);
    for (std::optional<FoundPath>& path : result.paths) {
      if (!path) continue;
      path = Straighten(problem, path->vertices, path->source, prices, result.effort);
    }
  }
  if (grid_guard_ && result.end == PlanEnd::kQueueExhausted) {
    CompleteOnGrid(problem, PathSource::kGridGuard, result);
  }
  for (const std::optional<FoundPath>& path : result.paths) {
    if (path && path->source == PathSource::kGridGuard) ++result.effort.goals_by_guard;
  }
  return result;
}

}  // namespace plumescout
