// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/goal_neighbours.h"

#include <algorithm>
#include <cstddef>

namespace plumescout {

std::vector<int> NearestSamples(std::span<const Point2> samples, Point2 goal, int count) {
  std::vector<std::pair<double, int>> by_distance;
  by_distance.reserve(samples.size());
  for (const Point2 sample : samples) {
    by_distance.emplace_back(Distance_m(sample, goal), static_cast<int>(by_distance.size()));
  }
  const auto size =
      std::min(static_cast<std::ptrdiff_t>(count), static_cast<std::ptrdiff_t>(by_distance.size()));
  std::partial_sort(by_distance.begin(), by_distance.begin() + size, by_distance.end());
  std::vector<int> nearest;
  for (std::ptrdiff_t k = 0; k < size; ++k) nearest.push_back((by_distance.begin() + k)->second);
  return nearest;
}

GoalNeighbours::GoalNeighbours(const std::vector<Point2>& points, int sample_count,
                               const std::vector<int>& goal_vertices, int nearest_sample_count) {
  const auto samples = std::span(points).first(static_cast<std::size_t>(sample_count));
  for (const int goal : goal_vertices) {
    const Point2 center = points[static_cast<std::size_t>(goal)];
    for (const int sample : NearestSamples(samples, center, nearest_sample_count)) {
      if (sample == goal) continue;
      edges_.emplace_back(sample, goal);
      edges_.emplace_back(goal, sample);
    }
  }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

std::span<const GoalNeighbours::Edge> GoalNeighbours::EdgesFrom(int vertex) const {
  const auto by_origin = [](const Edge& a, const Edge& b) { return a.first < b.first; };
  const auto [first, last] =
      std::equal_range(edges_.begin(), edges_.end(), Edge{vertex, 0}, by_origin);
  return {first, last};
}

}  // namespace plumescout
