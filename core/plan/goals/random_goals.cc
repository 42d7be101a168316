// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/random_goals.h"

#include <cstddef>
#include <utility>

#include "core/plan/goals/frontier_goals.h"

namespace plumescout {

std::vector<Goal> RandomGoals(const GoalQuery& query, Rng& rng) {
  const GridGeometry& geometry = query.reachable.geometry();
  const Point2 from = geometry.Center(query.start);
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < query.reachable.size(); ++i) {
    const Cell cell = geometry.CellAtIndex(i);
    if (query.reachable[i] != 0 && cell != query.start &&
        Distance_m(from, geometry.Center(cell)) >= query.options.min_goal_distance_m) {
      cells.push_back(i);
    }
  }
  const auto wanted = static_cast<std::size_t>(query.options.max_goals);
  std::vector<Goal> goals;
  for (std::size_t i = 0; i < cells.size() && goals.size() < wanted; ++i) {
    std::swap(cells[i], cells[i + rng.Below(cells.size() - i)]);
    Goal goal;
    goal.kind = GoalKind::kRandomFreeSpace;
    goal.cell = geometry.CellAtIndex(cells[i]);
    goal.position = geometry.Center(goal.cell);
    goal.centroid = goal.position;
    if (!RejectedByMemory(query, goal)) goals.push_back(goal);
  }
  return goals;
}

}  // namespace plumescout
