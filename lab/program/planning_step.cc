// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/planning_step.h"

#include <utility>

#include "core/plan/paths/path_planners.h"
#include "core/plan/selection/expected_information.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "ompl_planners/ompl_planner.h"

namespace plumescout::lab {
namespace {

// Plans as another does, and keeps the tree of the last search.
class TreeKeeper final : public PathPlanner {
 public:
  TreeKeeper(std::unique_ptr<const PathPlanner> planner, std::vector<TreeEdge>& tree)
      : planner_(std::move(planner)), tree_(tree) {}

  PathResult FindPaths(const PathProblem& problem) const override {
    PathProblem watched = problem;
    watched.tree = &tree_;
    return planner_->FindPaths(watched);
  }

 private:
  const std::unique_ptr<const PathPlanner> planner_;
  std::vector<TreeEdge>& tree_;
};

absl::StatusOr<PlanningOptions> OptionsOf(const Mission& mission, const std::string& strategy) {
  PlanningOptions options = mission.options().planning;
  if (!strategy.empty()) {
    options.strategy = strategy;
    PLUMESCOUT_RETURN_IF_ERROR(ApplyStrategyRow(options));
  }
  return options;
}

absl::StatusOr<RobotId> RobotOf(const Belief& belief, const RobotId& asked) {
  if (!asked.empty()) return asked;  // Strategy::Plan knows whether it is there
  if (belief.robots.empty()) return absl::NotFoundError("no robot is registered yet");
  return belief.robots.begin()->first;
}

// What the selection did not ask for, or did not need to know.
void PriceInformation(const Belief& belief, const PlanningOptions& options, Plan& plan) {
  if (belief.gas_what_if == nullptr) return;
  ExpectedInformation information(belief);
  for (Candidate& candidate : plan.candidates) {
    if (candidate.expected_information_nats) continue;
    candidate.expected_information_nats =
        information.Of(ReadingCells(candidate.path, belief.geometry(), options));
    candidate.information_bound_nats.reset();
  }
}

}  // namespace

absl::StatusOr<PlanningStep> TakePlanningStep(Mission& mission,
                                              const PlanningStepOptions& options) {
  if (mission.posterior_stale()) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const Applied refreshed,
                                mission.Apply(PosteriorRefreshed{mission.sample_time_ns()}));
    PLUMESCOUT_RETURN_IF_ERROR(refreshed.posterior);
  }
  PlanningStep step;
  step.belief = mission.Snapshot();
  const Belief& belief = *step.belief;
  PLUMESCOUT_ASSIGN_OR_RETURN(const PlanningOptions planning, OptionsOf(mission, options.strategy));
  PLUMESCOUT_ASSIGN_OR_RETURN(auto paths, MakePathPlanner(planning, MakeOmplPlanner));
  PlanRequest request;
  PLUMESCOUT_ASSIGN_OR_RETURN(request.robot, RobotOf(belief, options.robot));
  request.seed = options.seed;
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const auto strategy,
      MakeStrategyWith(planning, std::make_unique<const TreeKeeper>(std::move(paths), step.tree)));
  PLUMESCOUT_ASSIGN_OR_RETURN(step.plan, strategy->Plan(belief, request, NeverStop()));
  PriceInformation(belief, planning, step.plan);
  step.information =
      MakeInformationMap({*belief.traversable, *belief.gas_mean_ppm, *belief.gas_variance_ppm2,
                          mission.options().gas, mission.options().frontier},
                         planning);
  return step;
}

}  // namespace plumescout::lab
