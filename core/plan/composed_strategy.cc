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
#include "core/plan/anticipation.h"
#include "core/plan/cost/edge_cost.h"
#include "core/plan/cost/information_map.h"
#include "core/plan/explanation.h"
#include "core/plan/goals/goal_offer.h"
#include "core/plan/goals/travel_budget.h"
#include "core/plan/home_orders.h"
#include "core/plan/make_way.h"
#include "core/plan/plan_start.h"
#include "core/plan/right_of_way.h"
#include "core/plan/selection/choice.h"
#include "core/plan/selection/selection.h"
#include "core/plan/trajectory_timing.h"
#include "core/plan/wait_place.h"
#include "core/plan/way_left.h"
#include "core/plan/way_round.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Draws of goals and of samples must not follow each other's numbers.
constexpr std::uint64_t kGoalStream = 0x676F616C73ULL;

PlanEffort Sum(const PlanEffort& a, const PlanEffort& b) {
  return {a.samples + b.samples, a.vertices + b.vertices, a.edges_evaluated + b.edges_evaluated,
          a.goals_by_guard + b.goals_by_guard, a.batches + b.batches};
}

bool IsRejectedFor(RejectionReason reason, const Plan& plan) {
  return std::any_of(plan.rejected.begin(), plan.rejected.end(),
                     [reason](const RejectedGoal& goal) { return goal.reason == reason; });
}

// Whether it holds goals that are there for what there is to learn.
bool HasWork(const GoalOffer& offer) {
  return !offer.fallback && !offer.goals.empty() && offer.goals.front().kind != GoalKind::kHome;
}

void EndWithoutGoals(bool complete, Plan& plan) {
  plan.end = complete                ? PlanEnd::kMissionComplete
             : plan.rejected.empty() ? PlanEnd::kNoGoals
                                     : PlanEnd::kAllGoalsRejected;
  if (complete) plan.phase = MissionPhase::kComplete;
}

// Every goal that could be reached is too far away for the travel budget, or the deadline.
bool IsBudgetSpent(const Plan& plan) {
  const bool is_spent = IsRejectedFor(RejectionReason::kOverBudget, plan) ||
                        IsRejectedFor(RejectionReason::kOverDeadline, plan);
  return plan.candidates.empty() && is_spent && !IsRejectedFor(RejectionReason::kTraffic, plan);
}

// To the robots that go first, or round them.
void GiveWay(const SearchedWays& ways, Plan& plan) {
  const auto& [query, departure, problem, judge] = ways;
  // Who is to keep its goal may need any of the candidates.
  const StopFn stop = query.options.commitment_margin_share == 0.0 ? problem.stop : NeverStop();
  std::optional<Waits> waits =
      FindWaitsUntil(stop, query.belief, departure.yaw_rad, query.options, plan);
  if (!waits) return;
  GoOnOnWayLeft(ways, *waits, plan);
  LeadRound(ways, *waits, plan);
  YieldToRobots(*waits, departure.yaw_rad, query.options, plan);
}

}  // namespace

absl::StatusOr<plumescout::Plan> ComposedStrategy::Plan(const Belief& belief,
                                                        const PlanRequest& asked,
                                                        const StopFn& stop,
                                                        const PlanListener& improved) const {
  const PlanRequest request = WithOrders(belief, asked);
  PLUMESCOUT_ASSIGN_OR_RETURN(PlanStart start, BeginPlan(belief, request, options_));
  plumescout::Plan& plan = start.plan;
  if (start.departure) {
    if (request.go_home) plan.phase = MissionPhase::kReturning;
    const bool priced = options_.selection_rule == SelectionRule::kInformationRate;
    std::optional<Belief> ahead;
    if (options_.anticipate_robots && priced && !request.go_home) {
      ahead = Anticipate(belief, request.robot, options_, stop);
      if (stop()) return StoppedBeforeAnyPath();
    }
    const plumescout::Plan blank = plan;
    const Call call = {belief, nullptr, request, stop, improved};
    Call foreseen = call;
    foreseen.ahead = ahead ? &*ahead : nullptr;
    PLUMESCOUT_RETURN_IF_ERROR(PlanFrom(*start.departure, foreseen, plan));
    if (ahead && IsBudgetSpent(plan)) {
      plan = blank;
      PLUMESCOUT_RETURN_IF_ERROR(PlanFrom(*start.departure, call, plan));
    }
    if (IsBudgetSpent(plan)) {
      PLUMESCOUT_RETURN_IF_ERROR(PlanLastWayHome(*start.departure, call, plan));
    }
  }
  const PlanningOptions judging = InField(options_, belief.options->gas);
  Conclude(start.pose.yaw_rad, judging, plan);
  if (WaitOutOfTheWay(belief, options_, plan)) plan.explanation = Explain(plan, judging);
  if (IsOver(belief) && plan.end == PlanEnd::kMissionComplete) {
    plan.explanation = "Stay: the mission is complete.";
  }
  plan.explanation += WhySentHome(belief, request.robot) + WhyOver(belief);
  if (start.departure) MakeWay(belief, *start.departure, options_, stop, plan);
  plan.replan_after_s = ReplanAfter_s(belief, options_, plan);
  return std::move(plan);
}

void ComposedStrategy::Conclude(double start_yaw_rad, const PlanningOptions& options,
                                plumescout::Plan& plan) {
  if (plan.chosen >= 0) {
    const Candidate& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)];
    plan.phase = PhaseToward(chosen.goal.kind);
    plan.trajectory = TrajectoryOf(chosen, start_yaw_rad, options);
  }
  plan.explanation = Explain(plan, options);
}

absl::Status ComposedStrategy::PlanLastWayHome(const Departure& departure, const Call& call,
                                               plumescout::Plan& plan) const {
  PlanRequest request = call.request;
  request.go_home = true;
  plan.phase = MissionPhase::kReturning;
  const PlanEffort before = std::exchange(plan.effort, {});
  PLUMESCOUT_RETURN_IF_ERROR(
      PlanFrom(departure, {call.belief, nullptr, request, call.stop, call.improved}, plan));
  plan.effort = Sum(before, plan.effort);
  const bool searched = plan.end == PlanEnd::kAllGoalsReached ||
                        plan.end == PlanEnd::kQueueExhausted || plan.end == PlanEnd::kStopped;
  if (!searched && !IsRejectedFor(RejectionReason::kTraffic, plan)) {
    plan.end = PlanEnd::kMissionComplete;
    plan.phase = MissionPhase::kComplete;
  }
  return absl::OkStatus();
}

absl::Status ComposedStrategy::PlanFrom(const Departure& departure, const Call& call,
                                        plumescout::Plan& plan) const {
  const auto& [belief, ahead, request, stop, improved] = call;
  const Belief& foreseen = ahead != nullptr ? *ahead : belief;
  const MissionOptions& mission = *belief.options;
  const InformationMap information =
      MakeInformationMap({*belief.traversable, *belief.gas_mean_ppm, *foreseen.gas_variance_ppm2,
                          mission.gas, mission.frontier},
                         options_, stop);
  plan.field_flat = information.flat;
  const Cell start_cell = belief.geometry().CellAt(departure.start);
  const Grid<std::uint8_t> reachable =
      ReachableCells(*belief.traversable, {start_cell}, Connectivity::kEightNoCornerCut, stop);
  if (stop()) return StoppedBeforeAnyPath();

  Rng rng(plan.seed ^ kGoalStream);
  const GoalQuery query = {belief,     belief.robots.at(request.robot),
                           start_cell, reachable,
                           options_,   request.go_home,
                           ahead,      stop};
  GoalOffer goals = FindGoals(query, rng);
  query.from_start.reset();
  if (IsLimited(query) && !stop()) query.FromHome();
  if (stop()) return StoppedBeforeAnyPath();
  if (ahead != nullptr && !HasWork(goals)) {
    return PlanFrom(departure, {belief, nullptr, request, stop, improved}, plan);
  }
  std::move(goals.rejected.begin(), goals.rejected.end(), std::back_inserter(plan.rejected));
  if (goals.goals.empty()) {
    EndWithoutGoals(goals.complete, plan);
    return absl::OkStatus();
  }

  const EdgeCost selection_cost(information, options_.selection_cost, options_.alpha_per_m);
  const CandidateJudge judge = {selection_cost, *belief.gas_mean_ppm,
                                mission.gas.background_mean_ppm};
  const Judging judging = {query, goals.goals, departure, judge};
  const PathListener tell = [&](const PathResult& better) {
    const plumescout::Plan incumbent = Incumbent(judging, better, plan);
    if (incumbent.chosen >= 0) call.improved(incumbent);
  };
  const EdgeCost cost(information, options_.cost, options_.alpha_per_m);
  const PathProblem problem = {cost,
                               reachable,
                               departure.start,
                               goals.goals,
                               plan.seed,
                               request.max_edge_evaluations,
                               stop,
                               improved ? &tell : nullptr};
  const PathResult result = paths_->FindPaths(problem);
  TakeResults(judging, result, plan);
  const bool stopped_empty = plan.end == PlanEnd::kStopped && plan.candidates.empty();
  RejectOverBudget(query, plan);
  GiveWay({query, departure, problem, judge}, plan);
  if (ahead != nullptr) LeavePromisedSight(belief, plan);
  Choose(foreseen, InField(options_, mission.gas), stop, plan);
  if (plan.chosen >= 0) NoteWhomItWaitsFor(belief, departure.yaw_rad, options_, plan);
  const bool budget_spent = request.max_edge_evaluations > 0 &&
                            plan.effort.edges_evaluated >= request.max_edge_evaluations;
  return stopped_empty && !budget_spent ? StoppedBeforeAnyPath() : absl::OkStatus();
}

plumescout::Plan ComposedStrategy::Incumbent(const Judging& judging, PathResult result,
                                             plumescout::Plan plan) const {
  result.end = EndOf(result.paths, /*stopped=*/true);
  PlanningOptions options = options_;
  // It would cost the search its time.
  if (options.selection_rule == SelectionRule::kInformationRate) {
    options.selection_rule = SelectionRule::kLeastCost;
  }
  TakeResults(judging, result, plan);
  RejectOverBudget(judging.query, plan);
  YieldToRobots(judging.query.belief, judging.departure.yaw_rad, options_, plan);
  Choose(judging.query.belief, options, NeverStop(), plan);
  if (plan.chosen >= 0) {
    NoteWhomItWaitsFor(judging.query.belief, judging.departure.yaw_rad, options_, plan);
  }
  Conclude(judging.departure.yaw_rad, options, plan);
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
