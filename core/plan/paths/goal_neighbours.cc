// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/goal_neighbours.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace plumescout {

std::vector<int> NearestSamples(std::span<const Point2> samples, Point2 goal, int count) {
  const auto most = static_cast<std::size_t>(std::max(count, 0));
  std::vector<std::pair<double, int>> nearest;  // of those before, the nearest first
  for (std::size_t i = 0; i < samples.size() && most > 0; ++i) {
    const double distance_m = Distance_m(samples[i], goal);
    if (nearest.size() == most) {
      if (distance_m >= nearest.back().first) continue;
      nearest.pop_back();
    }
    const std::pair<double, int> sample = {distance_m, static_cast<int>(i)};
    nearest.insert(std::upper_bound(nearest.begin(), nearest.end(), sample), sample);
  }
  std::vector<int> indices;
  for (const auto& [distance_m, index] : nearest) indices.push_back(index);
  return indices;
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
