// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling_strategy.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/grid/flood.h"
#include "core/plan/cost/edge_cost.h"
#include "core/plan/cost/information_map.h"
#include "core/plan/explanation.h"
#include "core/plan/goals/travel_budget.h"
#include "core/plan/home_orders.h"
#include "core/plan/make_way.h"
#include "core/plan/right_of_way.h"
#include "core/plan/sampling/site_lattice.h"
#include "core/plan/sampling/ways.h"
#include "core/plan/selection/candidate_terms.h"
#include "core/plan/trajectory_timing.h"
#include "core/types/error_reason.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Through all stops; none if one of them cannot be reached.
std::optional<std::vector<Point2>> PathThrough(const Grid<std::uint8_t>& reachable, Point2 start,
                                               const std::vector<Site>& stops) {
  std::vector<Point2> path = {start};
  for (const Site& stop : stops) {
    const Way way = WaysFrom(reachable, path.back(), {stop.place}).front();
    if (way.vertices.empty()) return std::nullopt;
    path.insert(path.end(), way.vertices.begin() + 1, way.vertices.end());
  }
  return path;
}

// Prices errands as paths: cost is length.
class ErrandPricer {
 public:
  ErrandPricer(const Belief& belief, const PlanningOptions& options)
      : belief_(belief),
        information_(MakeInformationMap(
            {*belief.traversable, *belief.gas_mean_ppm, *belief.gas_variance_ppm2,
             belief.options->gas, belief.options->frontier},
            options)),
        cost_(information_, CostKind::kEuclidean, options.alpha_per_m) {}

  Candidate Price(const Errand& errand, const std::vector<Point2>& path) const {
    Candidate candidate =
        MakeCandidate(GoalAt(errand.stops.back()), path, PathSource::kGridSearch,
                      {cost_, *belief_.gas_mean_ppm, belief_.options->gas.background_mean_ppm});
    candidate.reward = errand.reward;
    for (const Site& stop : errand.stops) candidate.stops.push_back(stop.place);
    return candidate;
  }

 private:
  const Belief& belief_;
  const InformationMap information_;
  const EdgeCost cost_;
};

std::string Describe(const Plan& plan, const std::string& merit) {
  const Candidate& chosen = plan.candidates.front();
  const std::size_t stops = chosen.stops.size();
  return absl::StrFormat(
      "Drive %.1f m and sample at %d site%s, the last at (%.1f, %.1f), until %.0f s from now: %s.",
      chosen.length_m, stops, stops == 1 ? "" : "s", chosen.goal.position.x_m,
      chosen.goal.position.y_m, plan.trajectory.duration_s, merit);
}

bool HasReason(const Plan& plan, RejectionReason reason) {
  return std::any_of(plan.rejected.begin(), plan.rejected.end(),
                     [reason](const RejectedGoal& goal) { return goal.reason == reason; });
}

}  // namespace

absl::StatusOr<plumescout::Plan> SamplingStrategy::Plan(const Belief& belief,
                                                        const PlanRequest& asked,
                                                        const StopFn& stop,
                                                        const PlanListener& improved) const {
  const PlanRequest request = WithOrders(belief, asked);
  if (request.go_home) return home_->Plan(belief, request, stop, improved);
  PLUMESCOUT_ASSIGN_OR_RETURN(PlanStart start, BeginPlan(belief, request, options_));
  if (!start.departure) {
    start.plan.explanation = Explain(start.plan, options_);
    return std::move(start.plan);
  }
  if (IsOver(belief)) {
    start.plan.end = PlanEnd::kMissionComplete;
    start.plan.phase = MissionPhase::kComplete;
    start.plan.explanation = absl::StrCat("Stay: the mission is complete.", WhyOver(belief));
  } else {
    PLUMESCOUT_RETURN_IF_ERROR(PlanFrom(belief, stop, start));
  }
  // Before its mission is complete, or when its budget is spent, the robot drives home.
  const bool is_spent = (HasReason(start.plan, RejectionReason::kOverBudget) ||
                         HasReason(start.plan, RejectionReason::kOverDeadline)) &&
                        !HasReason(start.plan, RejectionReason::kTraffic);
  const bool is_done = start.plan.end == PlanEnd::kMissionComplete;
  if (start.plan.chosen < 0 &&
      (is_spent || (is_done && (options_.return_home || belief.deadline_ns)))) {
    PlanRequest way_home = request;
    way_home.go_home = true;
    PLUMESCOUT_ASSIGN_OR_RETURN(plumescout::Plan plan,
                                home_->Plan(belief, way_home, stop, improved));
    if (plan.chosen >= 0 || HasReason(plan, RejectionReason::kTraffic)) return plan;
    start.plan.end = PlanEnd::kMissionComplete;
    start.plan.phase = MissionPhase::kComplete;
    start.plan.explanation = plan.explanation;
  }
  MakeWay(belief, *start.departure, options_, stop, start.plan);
  return std::move(start.plan);
}

absl::Status SamplingStrategy::CheckInside(const RobotId& robot, Point2 place) const {
  if (!options_.sites.region) return absl::OkStatus();
  const auto& [min, max] = *options_.sites.region;
  const bool inside =
      place.x_m >= min.x_m && place.x_m <= max.x_m && place.y_m >= min.y_m && place.y_m <= max.y_m;
  if (inside) return absl::OkStatus();
  return TypedError(
      absl::StatusCode::kFailedPrecondition, reason::kOutsideRegion,
      absl::StrFormat("robot \"%s\" at (%.2f, %.2f) is outside planning.sites.region, from "
                      "(%.2f, %.2f) to (%.2f, %.2f)",
                      robot, place.x_m, place.y_m, min.x_m, min.y_m, max.x_m, max.y_m));
}

absl::Status SamplingStrategy::PlanFrom(const Belief& belief, const StopFn& stop,
                                        PlanStart& start) const {
  plumescout::Plan& plan = start.plan;
  const Departure& departure = *start.departure;
  const Cell start_cell = belief.geometry().CellAt(departure.start);
  const Grid<std::uint8_t> reachable =
      ReachableCells(*belief.traversable, {start_cell}, Connectivity::kEightNoCornerCut, stop);
  if (stop()) return StoppedBeforeAnyPath();
  const GoalQuery query = {belief, start.robot, start_cell, reachable, options_};
  const Sites sites = FindSites(query, LatticeOver(belief.geometry(), options_.sites));
  if (stop()) return StoppedBeforeAnyPath();
  PLUMESCOUT_ASSIGN_OR_RETURN(const SamplingChoice choice,
                              rule_->Choose({query, departure.start, sites, plan.seed, stop}));
  if (stop()) return StoppedBeforeAnyPath();
  if (!choice.errands.empty()) {
    PLUMESCOUT_RETURN_IF_ERROR(CheckInside(plan.robot, start.pose.position()));
  }
  plan.rejected = sites.rejected;
  const ErrandPricer pricer(belief, options_);
  for (const Errand& errand : choice.errands) {
    const auto path = PathThrough(reachable, departure.start, errand.stops);
    if (!path) continue;
    Candidate candidate = pricer.Price(errand, *path);
    PutBefore(departure.way_out, candidate);
    candidate.duration_s =
        TimeTrajectory(candidate.path, candidate.stops, departure.yaw_rad, options_).duration_s;
    plan.candidates.push_back(std::move(candidate));
  }
  RejectOverBudget(query, plan);
  YieldToRobots(belief, departure.yaw_rad, options_, plan);
  Conclude(choice, start);
  if (plan.chosen >= 0) NoteWhomItWaitsFor(belief, departure.yaw_rad, options_, plan);
  return absl::OkStatus();
}

void SamplingStrategy::Conclude(const SamplingChoice& choice, PlanStart& start) const {
  plumescout::Plan& plan = start.plan;
  if (!plan.candidates.empty()) {
    const Candidate& chosen = plan.candidates.front();
    plan.chosen = 0;
    plan.phase = choice.phase;
    plan.end = PlanEnd::kAllGoalsReached;
    plan.trajectory = TrajectoryOf(chosen, start.pose.yaw_rad, options_);
    plan.explanation = Describe(plan, choice.merit);
    return;
  }
  // What another robot is about to sample, or in the way of, may still be to do.
  const bool waits =
      HasReason(plan, RejectionReason::kClaimed) || HasReason(plan, RejectionReason::kTraffic);
  plan.end = waits ? PlanEnd::kAllGoalsRejected : PlanEnd::kMissionComplete;
  plan.phase = waits ? choice.phase : MissionPhase::kComplete;
  plan.explanation =
      waits ? Explain(plan, options_) : "Stay: no site is left to sample; the mission is complete.";
}

}  // namespace plumescout
