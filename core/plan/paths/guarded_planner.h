// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "core/plan/paths/path_planner.h"
#include "core/types/options.h"

namespace plumescout {

// A planner with what ours adds to any: goals that it missed though it ended by itself are
// completed on the grid (options.grid_guard), and its own paths are straightened
// (options.straighten).
class GuardedPlanner : public PathPlanner {
 public:
  GuardedPlanner(std::unique_ptr<const PathPlanner> planner, const PlanningOptions& options)
      : planner_(std::move(planner)),
        grid_guard_(options.grid_guard),
        straighten_(options.straighten) {}

  PathResult FindPaths(const PathProblem& problem) const override;

 private:
  std::unique_ptr<const PathPlanner> planner_;
  bool grid_guard_;
  bool straighten_;
};

}  // namespace plumescout
