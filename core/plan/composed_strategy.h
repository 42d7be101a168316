// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/plan/departure.h"
#include "core/plan/paths/path_planner.h"
#include "core/plan/selection/candidate_terms.h"
#include "core/plan/strategy.h"

namespace plumescout {

// Goals, paths and selection put together.
class ComposedStrategy : public Strategy {
 public:
  // REQUIRES: Validate(options).ok().
  ComposedStrategy(const PlanningOptions& options, std::unique_ptr<const PathPlanner> paths)
      : options_(options), paths_(std::move(paths)) {}

  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop) const override;

 private:
  // Everything from a place to start to the candidates and the choice. The error is
  // kDeadlineExceeded.
  absl::Status PlanFrom(const Departure& departure, const Belief& belief,
                        const PlanRequest& request, const StopFn& stop,
                        plumescout::Plan& plan) const;
  // The same home, for the travel budget is spent. The plan keeps its rejected goals; it is
  // complete if the robot is home, or there is no way.
  absl::Status PlanLastWayHome(const Departure& departure, const Belief& belief,
                               PlanRequest request, const StopFn& stop,
                               plumescout::Plan& plan) const;
  // Turns what the search found for `goals` into candidates and rejections.
  void TakeResults(const std::vector<Goal>& goals, const PathResult& result,
                   const CandidateJudge& judge, plumescout::Plan& plan) const;

  PlanningOptions options_;
  std::unique_ptr<const PathPlanner> paths_;
};

}  // namespace plumescout
