// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/composed_strategy.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/grid/flood.h"
#include "core/plan/edge_cost.h"
#include "core/plan/explanation.h"
#include "core/plan/goals/goal_set.h"
#include "core/plan/goals/travel_budget.h"
#include "core/plan/information_field.h"
#include "core/plan/plan_seed.h"
#include "core/plan/selection/choice.h"
#include "core/plan/trajectory_timing.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Draws of goals and of samples must not follow each other's numbers.
constexpr std::uint64_t kGoalStream = 0x676F616C73ULL;

// The common way out of the inflated zone comes first. It counts as length; its cells have no
// information penalty, and no choice depends on it.
void PutBefore(const std::vector<Point2>& way_out, Candidate& candidate) {
  candidate.path.insert(candidate.path.begin(), way_out.begin(), way_out.end());
  for (std::size_t i = 0; i < way_out.size(); ++i) {
    candidate.length_m += Distance_m(candidate.path[i], candidate.path[i + 1]);
  }
}

MissionPhase PhaseOf(GoalKind kind) {
  switch (kind) {
    case GoalKind::kGasFrontier:
    case GoalKind::kInformation:
      return MissionPhase::kGasProbing;
    case GoalKind::kOccupancyFrontier:
      return MissionPhase::kExploring;
    case GoalKind::kHome:
      return MissionPhase::kReturning;
    case GoalKind::kRandomFreeSpace:
      break;
  }
  return MissionPhase::kFallback;
}

PlanEffort Sum(const PlanEffort& a, const PlanEffort& b) {
  return {a.samples + b.samples, a.vertices + b.vertices, a.edges_evaluated + b.edges_evaluated,
          a.goals_by_guard + b.goals_by_guard, a.batches + b.batches};
}

bool HasOverBudget(const Plan& plan) {
  return std::any_of(plan.rejected.begin(), plan.rejected.end(), [](const RejectedGoal& goal) {
    return goal.reason == RejectionReason::kOverBudget;
  });
}

absl::Status Stopped() {
  return absl::DeadlineExceededError(
      "DEADLINE_BEFORE_FIRST_PLAN: planning was stopped before any path was found");
}

}  // namespace

absl::StatusOr<plumescout::Plan> ComposedStrategy::Plan(const Belief& belief,
                                                        const PlanRequest& request,
                                                        const StopFn& stop,
                                                        const PlanListener& improved) const {
  const auto robot = belief.robots.find(request.robot);
  if (robot == belief.robots.end()) {
    return absl::NotFoundError(absl::StrCat("robot \"", request.robot, "\" is not registered"));
  }
  PLUMESCOUT_ASSIGN_OR_RETURN(const Pose2 pose,
                              StartPose(belief, request, robot->second, options_));
  plumescout::Plan plan;
  plan.robot = request.robot;
  plan.strategy = options_.strategy;
  plan.belief_revision = belief.revision;
  plan.seed = request.seed != 0 ? request.seed
                                : DerivedPlanSeed(belief.options->seed, request.robot,
                                                  robot->second.plans_issued);
  plan.phase = MissionPhase::kFallback;
  if (std::optional<Departure> departure = Depart(belief, pose.position())) {
    departure->yaw_rad = pose.yaw_rad;
    plan.start_escaped = !departure->way_out.empty();
    if (request.go_home) plan.phase = MissionPhase::kReturning;
    const Call call = {belief, request, stop, improved};
    PLUMESCOUT_RETURN_IF_ERROR(PlanFrom(*departure, call, plan));
    if (plan.candidates.empty() && HasOverBudget(plan)) {
      PLUMESCOUT_RETURN_IF_ERROR(PlanLastWayHome(*departure, call, plan));
    }
  } else {
    plan.end = PlanEnd::kStartOccupied;
  }
  Conclude(pose.yaw_rad, options_.selection, plan);
  return plan;
}

void ComposedStrategy::Conclude(double start_yaw_rad, SelectionRule rule,
                                plumescout::Plan& plan) const {
  if (plan.chosen >= 0) {
    const Candidate& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)];
    plan.phase = PhaseOf(chosen.goal.kind);
    plan.trajectory = TimeTrajectory(chosen.path, start_yaw_rad, options_);
  }
  plan.explanation = Explain(plan, rule);
}

absl::Status ComposedStrategy::PlanLastWayHome(const Departure& departure, const Call& call,
                                               plumescout::Plan& plan) const {
  PlanRequest request = call.request;
  request.go_home = true;
  plan.phase = MissionPhase::kReturning;
  const PlanEffort before = std::exchange(plan.effort, {});
  PLUMESCOUT_RETURN_IF_ERROR(
      PlanFrom(departure, {call.belief, request, call.stop, call.improved}, plan));
  plan.effort = Sum(before, plan.effort);
  const bool searched = plan.end == PlanEnd::kAllGoalsReached ||
                        plan.end == PlanEnd::kQueueExhausted || plan.end == PlanEnd::kStopped;
  if (!searched) {
    plan.end = PlanEnd::kMissionComplete;
    plan.phase = MissionPhase::kComplete;
  }
  return absl::OkStatus();
}

absl::Status ComposedStrategy::PlanFrom(const Departure& departure, const Call& call,
                                        plumescout::Plan& plan) const {
  const auto& [belief, request, stop, improved] = call;
  const MissionOptions& mission = *belief.options;
  const InformationField field =
      MakeInformationField({*belief.traversable, *belief.gas_mean_ppm, *belief.gas_variance_ppm2,
                            mission.gas, mission.frontier},
                           options_);
  plan.field_flat = field.flat;
  const Cell start_cell = belief.geometry().CellAt(departure.start);
  const Grid<std::uint8_t> reachable = ReachableCells(*belief.traversable, {start_cell});
  if (stop()) return Stopped();

  Rng rng(plan.seed ^ kGoalStream);
  const GoalQuery query = {
      belief, belief.robots.at(request.robot), start_cell, reachable, options_, request.go_home};
  GoalSet goals = FindGoals(query, rng);
  std::move(goals.rejected.begin(), goals.rejected.end(), std::back_inserter(plan.rejected));
  if (goals.goals.empty()) {
    plan.end = goals.complete          ? PlanEnd::kMissionComplete
               : plan.rejected.empty() ? PlanEnd::kNoGoals
                                       : PlanEnd::kAllGoalsRejected;
    plan.phase = goals.complete ? MissionPhase::kComplete : plan.phase;
    return absl::OkStatus();
  }
  if (stop()) return Stopped();

  const EdgeCost selection_cost(field, options_.selection_cost, options_.alpha);
  const CandidateJudge judge = {selection_cost, *belief.gas_mean_ppm,
                                mission.gas.background_mean_ppm};
  const Judging judging = {query, goals.goals, departure, judge};
  const PathListener tell = [&](const PathResult& better) {
    const plumescout::Plan incumbent = Incumbent(judging, better, plan);
    if (incumbent.chosen >= 0) call.improved(incumbent);
  };
  const EdgeCost cost(field, options_.cost, options_.alpha);
  const PathResult result =
      paths_->FindPaths({cost, reachable, departure.start, goals.goals, plan.seed,
                         request.max_edge_evaluations, stop, improved ? &tell : nullptr});
  TakeResults(judging, result, plan);
  const bool stopped_empty = plan.end == PlanEnd::kStopped && plan.candidates.empty();
  RejectOverBudget(query, plan);
  Choose(belief, options_, stop, plan);
  const bool budget_spent = request.max_edge_evaluations > 0 &&
                            plan.effort.edges_evaluated >= request.max_edge_evaluations;
  return stopped_empty && !budget_spent ? Stopped() : absl::OkStatus();
}

plumescout::Plan ComposedStrategy::Incumbent(const Judging& judging, PathResult result,
                                             plumescout::Plan plan) const {
  result.end = EndOf(result.paths, /*stopped=*/true);
  PlanningOptions options = options_;
  // It would cost the search its time.
  if (options.selection == SelectionRule::kInformationRate) {
    options.selection = SelectionRule::kLeastCost;
  }
  TakeResults(judging, result, plan);
  RejectOverBudget(judging.query, plan);
  Choose(judging.query.belief, options, NeverStop(), plan);
  Conclude(judging.departure.yaw_rad, options.selection, plan);
  return plan;
}

void ComposedStrategy::TakeResults(const Judging& judging, const PathResult& result,
                                   plumescout::Plan& plan) const {
  const auto& [query, goals, departure, judge] = judging;
  plan.end = result.end;
  plan.effort = result.effort;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    if (const std::optional<FoundPath>& path = result.paths[i]) {
      plan.candidates.push_back(MakeCandidate(goals[i], path->vertices, path->source, judge));
    } else if (result.end == PlanEnd::kStopped) {
      plan.rejected.push_back({goals[i], RejectionReason::kSearchStopped, ""});
    } else {
      plan.rejected.push_back({goals[i], RejectionReason::kUnreachable, "the search ran out"});
    }
  }
  for (Candidate& candidate : plan.candidates) {
    PutBefore(departure.way_out, candidate);
    candidate.duration_s = TimeTrajectory(candidate.path, departure.yaw_rad, options_).duration_s;
  }
}

}  // namespace plumescout
