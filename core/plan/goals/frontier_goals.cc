// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/frontier_goals.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/frontier/gas_frontier.h"
#include "core/frontier/occupancy_frontier.h"

namespace plumescout {
namespace {

std::vector<Frontier> GasFrontiers(const GoalQuery& query) {
  const Belief& belief = query.belief;
  const GasFrontierInput input{*belief.occupancy, *belief.traversable, *belief.gas_mean_ppm,
                               *belief.gas_variance_ppm2};
  const FrontierOptions& options = belief.options->frontier;
  const double observed_ppm2 = ObservedVariance_ppm2(options, belief.options->gas);
  return FindGasFrontiers(input, observed_ppm2, GasThreshold_ppm(input, observed_ppm2, options),
                          {query.start}, options);
}

Goal GoalOf(const Frontier& frontier, const GridGeometry& geometry) {
  Goal goal;
  goal.kind =
      frontier.kind == FrontierKind::kGas ? GoalKind::kGasFrontier : GoalKind::kOccupancyFrontier;
  goal.centroid = frontier.centroid;
  // A frontier without a way to it has no goal cell: the label stands for it.
  goal.cell = frontier.reachable ? frontier.goal_cell : geometry.CellAt(frontier.centroid);
  goal.position = frontier.reachable ? geometry.Center(frontier.goal_cell) : frontier.centroid;
  goal.frontier_cells = static_cast<int>(frontier.cells.size());
  return goal;
}

std::optional<RejectedGoal> Rejected(const GoalQuery& query, const Frontier& frontier,
                                     const Goal& goal) {
  if (frontier.too_small) {
    return RejectedGoal{goal, RejectionReason::kTooSmall,
                        absl::StrCat(goal.frontier_cells, " cells")};
  }
  if (!frontier.reachable) {
    return RejectedGoal{goal, RejectionReason::kUnreachable, "no traversable way"};
  }
  if (std::optional<RejectedGoal> rejected = RejectedByMemory(query, goal)) return rejected;
  if (frontier.travel_m < query.options.min_goal_distance_m) {
    return RejectedGoal{goal, RejectionReason::kTooClose,
                        absl::StrFormat("%.2f m away", frontier.travel_m)};
  }
  return std::nullopt;
}

void Judge(const GoalQuery& query, const std::vector<Frontier>& frontiers,
           std::vector<OfferedGoal>& offered, std::vector<RejectedGoal>& rejected) {
  for (const Frontier& frontier : frontiers) {
    const Goal goal = GoalOf(frontier, query.belief.geometry());
    if (std::optional<RejectedGoal> rejection = Rejected(query, frontier, goal)) {
      rejected.push_back(*std::move(rejection));
    } else {
      offered.push_back({goal, frontier.travel_m});
    }
  }
}

}  // namespace

std::optional<RejectedGoal> RejectedByMemory(const GoalQuery& query, const Goal& goal) {
  const Belief& belief = query.belief;
  for (const SetAsideGoal& aside : belief.set_aside) {
    if (aside.expires_ns > belief.sample_time_ns && SameGoal(aside.goal, goal)) {
      constexpr double kSecondsPerNanosecond = 1e-9;
      const double left_s =
          static_cast<double>(aside.expires_ns - belief.sample_time_ns) * kSecondsPerNanosecond;
      return RejectedGoal{goal, RejectionReason::kSetAside,
                          absl::StrFormat("%s, for another %.0f s", aside.reason, left_s)};
    }
  }
  for (const GoalClaim& claim : belief.claims) {
    if (claim.robot != query.robot.state.id && claim.expires_ns > belief.sample_time_ns &&
        SameGoal(claim.goal, goal)) {
      return RejectedGoal{goal, RejectionReason::kClaimed,
                          absl::StrCat("by robot \"", claim.robot, "\"")};
    }
  }
  return std::nullopt;
}

FrontierGoals FindFrontierGoals(const GoalQuery& query) {
  const Belief& belief = query.belief;
  FrontierGoals found;
  if (query.options.goals != GoalPolicy::kOccupancyOnly) {
    Judge(query, GasFrontiers(query), found.gas, found.rejected);
  }
  Judge(query,
        FindOccupancyFrontiers(*belief.occupancy, *belief.traversable, {query.start},
                               belief.options->frontier.min_occupancy_cells),
        found.occupancy, found.rejected);
  return found;
}

}  // namespace plumescout
