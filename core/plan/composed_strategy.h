// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/plan/departure.h"
#include "core/plan/goals/goal_offer.h"
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

  using Strategy::Plan;
  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop,
                                        const PlanListener& improved) const override;

 private:
  // What Plan was called with.
  struct Call {
    const Belief& belief;
    const Belief* ahead;  // see GoalQuery
    const PlanRequest& request;
    const StopFn& stop;
    const PlanListener& improved;
  };
  // What the results of a search are judged by.
  struct Judging {
    const GoalQuery& query;
    const std::vector<Goal>& goals;
    const Departure& departure;
    const CandidateJudge& judge;
  };

  // Everything from a place to start to the candidates and the choice. If nothing is left beside
  // what other robots are about to learn, as if they promised nothing. The error is
  // kDeadlineExceeded.
  absl::Status PlanFrom(const Departure& departure, const Call& call, plumescout::Plan& plan) const;
  // PlanFrom home, for the travel budget is spent. The plan keeps its rejected goals; it is
  // complete if the robot is home, or there is no way.
  absl::Status PlanLastWayHome(const Departure& departure, const Call& call,
                               plumescout::Plan& plan) const;
  // Turns what the search found into candidates and rejections.
  void TakeResults(const Judging& judging, const PathResult& result, plumescout::Plan& plan) const;
  // The plan that the search would end with now; `plan` is what was known before it.
  plumescout::Plan Incumbent(const Judging& judging, PathResult result,
                             plumescout::Plan plan) const;
  // What follows from the choice, which was made by `options`.
  static void Conclude(double start_yaw_rad, const PlanningOptions& options,
                       plumescout::Plan& plan);

  PlanningOptions options_;
  std::unique_ptr<const PathPlanner> paths_;
};

}  // namespace plumescout
