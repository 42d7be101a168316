// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/goal_sets.h"

#include <algorithm>
#include <cstddef>

namespace plumescout {

GoalSets::GoalSets(const std::vector<Point2>& points, int sample_count,
                   const std::vector<int>& goal_vertices, int nearest_samples) {
  std::vector<std::pair<double, int>> by_distance(static_cast<std::size_t>(sample_count));
  const auto set_size = std::min(nearest_samples, sample_count);
  for (const int goal : goal_vertices) {
    for (int i = 0; i < sample_count; ++i) {
      const auto index = static_cast<std::size_t>(i);
      by_distance[index] = {Distance_m(points[index], points[static_cast<std::size_t>(goal)]), i};
    }
    std::partial_sort(by_distance.begin(), by_distance.begin() + set_size, by_distance.end());
    for (int k = 0; k < set_size; ++k) {
      const int sample = by_distance[static_cast<std::size_t>(k)].second;
      if (sample == goal) continue;
      edges_.emplace_back(sample, goal);
      edges_.emplace_back(goal, sample);
    }
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

std::span<const GoalSets::Edge> GoalSets::EdgesFrom(int vertex) const {
  const auto by_origin = [](const Edge& a, const Edge& b) { return a.first < b.first; };
  const auto [first, last] =
      std::equal_range(edges_.begin(), edges_.end(), Edge{vertex, 0}, by_origin);
  return {first, last};
}

}  // namespace plumescout
