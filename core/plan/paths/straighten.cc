// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/straighten.h"

#include <utility>

#include "core/plan/paths/shortcut.h"
#include "core/plan/paths/vertex_adjustment.h"

namespace plumescout {

FoundPath Straighten(const PathProblem& problem, const std::vector<Point2>& way, PathSource source,
                     EdgePrices& prices, PlanEffort& effort) {
  if (problem.cost.CountsVerticesOnly()) return {way, PathCost(problem.cost, way), source};
  const StopFn stop = [&] {
    const std::int64_t budget = problem.max_edge_evaluations;
    return (budget > 0 && effort.edges_evaluated >= budget) || problem.stop();
  };
  ShortcutPath path = Shortcut(prices, way, stop);
  effort.edges_evaluated += path.edges_evaluated;
  path.edges_evaluated = 0;
  AdjustVertices(prices, stop, path);
  effort.edges_evaluated += path.edges_evaluated;
  path = Shortcut(prices, path.vertices, stop);
  effort.edges_evaluated += path.edges_evaluated;
  return {std::move(path.vertices), path.cost, source};
}

}  // namespace plumescout
