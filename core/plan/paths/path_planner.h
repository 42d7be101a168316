// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/plan/cost/edge_cost.h"
#include "core/types/grid.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"
#include "core/types/stop.h"

namespace plumescout {

struct FoundPath {
  // The start first, the centre of the goal's cell last; or, with options.goal_vertices off, that
  // of a sample near it.
  std::vector<Point2> vertices;
  double cost = 0.0;  // under PathProblem::cost
  PathSource source = PathSource::kTree;

  friend bool operator==(const FoundPath&, const FoundPath&) = default;
};

struct PathResult {
  std::vector<std::optional<FoundPath>> paths;  // one per goal, in their order
  // kAllGoalsReached, kQueueExhausted, or kStopped by the stop function or the budget.
  PlanEnd end = PlanEnd::kQueueExhausted;
  PlanEffort effort;
};

// How a search ended that has all it can find, or was stopped.
inline PlanEnd EndOf(const std::vector<std::optional<FoundPath>>& paths, bool stopped) {
  const bool all =
      std::all_of(paths.begin(), paths.end(), [](const auto& path) { return path.has_value(); });
  if (all) return PlanEnd::kAllGoalsReached;
  return stopped ? PlanEnd::kStopped : PlanEnd::kQueueExhausted;
}

// Told of every better answer of an anytime search; no price in it is above an earlier one.
using PathListener = std::function<void(const PathResult&)>;

// One edge of a search tree.
struct TreeEdge {
  Point2 parent;
  Point2 child;

  friend bool operator==(const TreeEdge&, const TreeEdge&) = default;
};

// From where, to where, at what price. Holds references: for the length of one call.
struct PathProblem {
  const EdgeCost& cost;                 // of tree expansion, with the information it prices
  const Grid<std::uint8_t>& reachable;  // 1: traversable and connected to the start
  Point2 start;                         // in a reachable cell
  const std::vector<Goal>& goals;
  std::uint64_t seed = 0;
  std::int64_t max_edge_evaluations = 0;  // 0: no bound
  const StopFn& stop;
  const PathListener* improved = nullptr;
  // For those who want to look: gets every edge of the tree that was grown, of a search in batches
  // those of its last. Planners that grow none of ours leave it as it is.
  std::vector<TreeEdge>* tree = nullptr;

  Cell start_cell() const { return cost.geometry().CellAt(start); }
};

// Finds collision-free paths from one start to many goals. Immutable; FindPaths may run on many
// threads at once. Same problem: same bytes, unless the stop function says so: a search polls it
// many times a millisecond, and returns what was found so far.
class PathPlanner {
 public:
  virtual ~PathPlanner() = default;
  virtual PathResult FindPaths(const PathProblem& problem) const = 0;
};

}  // namespace plumescout
