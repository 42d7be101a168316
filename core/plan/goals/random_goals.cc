// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/random_goals.h"

#include <cstddef>
#include <utility>

#include "core/frontier/gas_frontier.h"
#include "core/plan/goals/frontier_goals.h"

namespace plumescout {
namespace {

// Draws from the reachable cells that `wanted(cell)` holds for.
template <typename Predicate>
std::vector<Goal> DrawGoals(const GoalQuery& query, GoalKind kind, Rng& rng,
                            const Predicate& wanted) {
  const GridGeometry& geometry = query.reachable.geometry();
  const Point2 from = geometry.Center(query.start);
  std::vector<std::size_t> cells;
  const auto add = [&](std::size_t i) {
    const Cell cell = geometry.CellAtIndex(i);
    if (query.reachable[i] != 0 && cell != query.start && wanted(cell) &&
        Distance_m(from, geometry.Center(cell)) >= query.options.min_goal_distance_m) {
      cells.push_back(i);
    }
  };
  const bool is_whole =
      InPieces(query.reachable.size(), query.stop, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) add(i);
      });
  if (!is_whole) return {};
  const auto limit = static_cast<std::size_t>(query.options.max_goal_count);
  std::vector<Goal> goals;
  for (std::size_t i = 0; i < cells.size() && goals.size() < limit; ++i) {
    std::swap(cells[i], cells[i + rng.Below(cells.size() - i)]);
    Goal goal;
    goal.kind = kind;
    goal.cell = geometry.CellAtIndex(cells[i]);
    goal.position = geometry.Center(goal.cell);
    goal.centroid = goal.position;
    if (!RejectedByMemory(query, goal)) goals.push_back(goal);
  }
  return goals;
}

}  // namespace

std::vector<Goal> RandomGoals(const GoalQuery& query, Rng& rng) {
  return DrawGoals(query, GoalKind::kRandomFreeSpace, rng, [](Cell) { return true; });
}

std::vector<Goal> UnobservedGoals(const GoalQuery& query, Rng& rng) {
  const Grid<float>& variance_ppm2 = *query.belief.gas_variance_ppm2;
  const auto limit_ppm2 = static_cast<float>(
      ObservedVariance_ppm2(query.belief.options->frontier, query.belief.options->gas));
  return DrawGoals(query, GoalKind::kInformation, rng, [&](Cell cell) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        // Off free cells the variance is NaN: neither observed nor to be.
        if (variance_ppm2.At({cell.x + dx, cell.y + dy}, limit_ppm2) <= limit_ppm2) return false;
      }
    }
    return true;
  });
}

}  // namespace plumescout
