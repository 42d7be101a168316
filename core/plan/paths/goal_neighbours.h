// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/types/pose2.h"

namespace plumescout {

// The goal sets of [XIT] Alg. 1 lines 3-5. Ours: a goal's own cell is a vertex of the graph and
// every path ends there, not at a sample somewhere near the frontier. The k_n nearest samples, its
// neighbours, have an edge to that vertex, however long; one that does not see the goal's cell does
// not count because its edge is blocked.
class GoalNeighbours {
 public:
  // `points` holds the samples first, `sample_count` of them. `goal_vertices` index into `points`.
  // Cost: O(goals * samples).
  GoalNeighbours(const std::vector<Point2>& points, int sample_count,
                 const std::vector<int>& goal_vertices, int nearest_sample_count);

  using Edge = std::pair<int, int>;  // from vertex, to vertex; each edge stands in both directions
  std::span<const Edge> EdgesFrom(int vertex) const;

 private:
  std::vector<Edge> edges_;  // sorted
};

// Indices of the `count` samples nearest to `goal`, the nearest first; all if there are fewer.
std::vector<int> NearestSamples(std::span<const Point2> samples, Point2 goal, int count);

}  // namespace plumescout
