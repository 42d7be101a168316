// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/grid_guard.h"

#include <cstddef>
#include <cstdint>

#include "core/grid/mask.h"
#include "core/plan/paths/cost_search.h"
#include "core/plan/paths/straighten.h"

namespace plumescout {
namespace {

std::vector<Cell> MissedGoals(const PathProblem& problem, const PathResult& result) {
  std::vector<Cell> missed;
  for (std::size_t i = 0; i < result.paths.size(); ++i) {
    const Cell cell = problem.goals[i].cell;
    if (!result.paths[i] && problem.reachable.At(cell, 0) != 0) missed.push_back(cell);
  }
  return missed;
}

}  // namespace

void CompleteOnGrid(const PathProblem& problem, PathSource source, PathResult& result) {
  const std::vector<Cell> missed = MissedGoals(problem, result);
  bool stopped = false;
  if (!missed.empty()) {
    // Nothing else can be reached.
    CostSearch search(problem.cost, BoundsOf(problem.reachable, std::uint8_t{1}), problem.stop);
    EdgePrices prices(problem.cost);
    stopped = !search.Run(problem.start_cell(), missed, problem.stop);
    for (std::size_t i = 0; i < result.paths.size(); ++i) {
      if (result.paths[i] || problem.reachable.At(problem.goals[i].cell, 0) == 0) continue;
      const std::vector<Point2> way = search.WayTo(problem.goals[i].cell, problem.start);
      if (way.empty()) continue;
      result.paths[i] = Straighten(problem, way, source, prices, result.effort);
    }
  }
  result.end = EndOf(result.paths, stopped);
}

}  // namespace plumescout
