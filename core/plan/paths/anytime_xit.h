// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/paths/path_planner.h"
#include "core/types/options.h"

namespace plumescout {

// Ours, what [XIT] section VIII leaves to the future: XIT on batches of samples that double, from
// kFirstBatch on, until the problem is stopped, its edge budget is spent, or two batches in a row
// have made no path cheaper by kLeastGain. Each batch is searched, completed and straightened as
// options say, and the cheapest path to each goal is kept: no price ever rises. The listener hears
// of every batch that brought something. Paths always end at goal cells, or those that stop short
// would pass for cheap.
//
// Ends as kAllGoalsReached whenever all goals have a path, also if it was stopped.
// Cost: twice that of its largest batch.
class AnytimeXitPlanner : public PathPlanner {
 public:
  static constexpr int kFirstBatch = 75;
  static constexpr double kLeastGain = 1e-3;  // of a path's price

  // REQUIRES: Validate(options).ok(). options.sample_count and goal_vertices have no effect.
  explicit AnytimeXitPlanner(const PlanningOptions& options) : options_(options) {}

  PathResult FindPaths(const PathProblem& problem) const override;

 private:
  PathResult SearchBatch(const PathProblem& problem, int samples) const;

  PlanningOptions options_;
};

}  // namespace plumescout
