// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/paths/path_planner.h"
#include "core/types/options.h"

namespace plumescout {

// Exploration and exploitation informed trees, [XIT] Alg. 1: one tree over a batch of samples of
// the information map, grown towards all goals in turn. [MIT] Alg. 1 is the same search under the
// distance as cost, with independent samples of the information map alone (strategy "mit").
//
// Where the listing leaves room:
//   line 8      while some goal is unreached and Q_v is not empty.
//   line 13     one Q_v ordered for each goal by g + h, h = alpha * distance to that goal. h is
//               consistent for each, so a vertex taken from Q_v has its final g whatever the
//               order of turns: it is never rewired. With options.informed_heuristic, h of section
//               IV-C is not: a vertex that is rewired goes back into Q_v, which the listing
//               forgets.
//   line 16-18  Q_e is drained for one vertex, so its order cannot change the tree: no sort.
//   line 20-21  "<" in both; "<=" as [MIT] prints would rewire ties for ever.
//   goals       as in goal_neighbours.h; a goal is solved when its vertex is taken from Q_v, not
//               when an edge first touches it. Without options.goal_vertices, as in the paper, a
//               path ends at that neighbour of the goal that is the cheapest to reach.
// A goal touched but not solved when the search is stopped still gets the path found so far.
//
// Cost: O(cells) for the draw, then about N log N queue steps and edge integrals.
class XitPlanner : public PathPlanner {
 public:
  // REQUIRES: Validate(options).ok().
  explicit XitPlanner(const PlanningOptions& options) : options_(options) {}

  PathResult FindPaths(const PathProblem& problem) const override;

 private:
  PlanningOptions options_;
};

}  // namespace plumescout
