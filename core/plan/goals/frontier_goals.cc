// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/frontier_goals.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/frontier/gas_frontier.h"
#include "core/frontier/occupancy_frontier.h"
#include "core/occupancy/keep_out.h"

namespace plumescout {
namespace {

// A gas frontier lies on free cells, and only a reading taken there resolves it. So its goal is one
// of its own cells that the robot can stand on, the one nearest to their middle; without any, as
// along a wall within the inflation radius, no visit could change it.
void MoveGoalOntoFrontier(const GoalQuery& query, Frontier& frontier) {
  const GridGeometry& geometry = query.belief.geometry();
  std::vector<Cell> standable;
  Point2 middle;
  for (const Cell cell : frontier.cells) {
    if (query.reachable[cell] == 0) continue;
    standable.push_back(cell);
    middle.x_m += geometry.Center(cell).x_m;
    middle.y_m += geometry.Center(cell).y_m;
  }
  frontier.reachable = !standable.empty();
  if (standable.empty()) return;
  middle.x_m /= static_cast<double>(standable.size());
  middle.y_m /= static_cast<double>(standable.size());
  double least_m = std::numeric_limits<double>::infinity();
  for (const Cell cell : standable) {
    const double distance_m = Distance_m(geometry.Center(cell), middle);
    if (distance_m >= least_m) continue;
    least_m = distance_m;
    frontier.goal_cell = cell;
  }
}

std::vector<Frontier> GasFrontiers(const GoalQuery& query) {
  const Belief& belief = query.belief;
  const GasFrontierInput input{*belief.occupancy, *belief.traversable, *belief.gas_mean_ppm,
                               *belief.gas_variance_ppm2};
  const FrontierOptions& options = belief.options->frontier;
  const double observed_ppm2 = ObservedVariance_ppm2(options, belief.options->gas);
  std::vector<Frontier> frontiers = FindGasClusters(
      input, observed_ppm2, GasThreshold_ppm(input, observed_ppm2, options, query.stop),
      {query.start}, options, query.stop);
  if (frontiers.empty()) return {};
  for (Frontier& frontier : frontiers) {
    if (Stops(query.stop)) return {};
    MoveGoalOntoFrontier(query, frontier);
    if (frontier.reachable) frontier.travel_m = query.FromStart().Travel(frontier.goal_cell);
  }
  return frontiers;
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

// Whether another robot is about to take readings that make it no frontier any more.
bool WillBeObserved(const GoalQuery& query, const Goal& goal) {
  if (query.ahead == nullptr || goal.kind != GoalKind::kGasFrontier) return false;
  const MissionOptions& mission = *query.belief.options;
  const auto variance_ppm2 = static_cast<double>((*query.ahead->gas_variance_ppm2)[goal.cell]);
  return variance_ppm2 <= ObservedVariance_ppm2(mission.frontier, mission.gas);
}

std::optional<RejectedGoal> Rejected(const GoalQuery& query, const Frontier& frontier,
                                     const Goal& goal, const Grid<std::uint8_t>& kept_out) {
  if (frontier.too_small) {
    return RejectedGoal{goal, RejectionReason::kTooSmall,
                        absl::StrCat(goal.frontier_cells, " cells")};
  }
  const auto is_kept_out = [&](Cell cell) { return kept_out.At(cell, 0) != 0; };
  if (std::all_of(frontier.cells.begin(), frontier.cells.end(), is_kept_out)) {
    return RejectedGoal{goal, RejectionReason::kKeptOut, "all of it lies in keep-out areas"};
  }
  if (!frontier.reachable) {
    return RejectedGoal{goal, RejectionReason::kUnreachable, "no traversable way"};
  }
  if (std::optional<RejectedGoal> rejected = RejectedByMemory(query, goal)) return rejected;
  if (WillBeObserved(query, goal)) {
    return RejectedGoal{goal, RejectionReason::kClaimed, "on another robot's way"};
  }
  if (frontier.travel_m < query.options.min_goal_distance_m) {
    return RejectedGoal{goal, RejectionReason::kTooClose,
                        absl::StrFormat("%.2f m away", frontier.travel_m)};
  }
  return std::nullopt;
}

void Judge(const GoalQuery& query, const std::vector<Frontier>& frontiers,
           std::vector<JudgedFrontier>& judged) {
  // An empty raster holds no cell.
  const std::vector<Polygon>& areas = query.belief.options->keep_out;
  const Grid<std::uint8_t> kept_out =
      areas.empty() ? Grid<std::uint8_t>() : KeptOutCells(areas, query.belief.geometry());
  for (const Frontier& frontier : frontiers) {
    JudgedFrontier& added = judged.emplace_back();
    added.goal = GoalOf(frontier, query.belief.geometry());
    if (frontier.reachable) added.travel_m = frontier.travel_m;
    added.rejection = Rejected(query, frontier, added.goal, kept_out);
  }
}

}  // namespace

std::optional<RejectedGoal> RejectedByMemory(const GoalQuery& query, const Goal& goal) {
  const Belief& belief = query.belief;
  for (const SetAsideGoal& aside : belief.set_aside) {
    if (aside.expires_ns > belief.sample_time_ns && SamePlace(aside.goal, goal)) {
      constexpr double kSecondsPerNanosecond = 1e-9;
      const double left_s =
          static_cast<double>(aside.expires_ns - belief.sample_time_ns) * kSecondsPerNanosecond;
      return RejectedGoal{goal, RejectionReason::kSetAside,
                          absl::StrFormat("%s, for another %.0f s", aside.reason, left_s)};
    }
  }
  for (const GoalClaim& claim : belief.claims) {
    if (claim.robot != query.robot.state.id && claim.expires_ns > belief.sample_time_ns &&
        IsSameErrand(claim.goal, goal)) {
      return RejectedGoal{goal, RejectionReason::kClaimed,
                          absl::StrCat("by robot \"", claim.robot, "\"")};
    }
  }
  return std::nullopt;
}

std::vector<JudgedFrontier> JudgeFrontiers(const GoalQuery& query) {
  const Belief& belief = query.belief;
  std::vector<JudgedFrontier> judged;
  if (query.options.goal_policy != GoalPolicy::kOccupancyOnly) {
    Judge(query, GasFrontiers(query), judged);
  }
  if (Stops(query.stop)) return judged;
  Judge(query,
        FindOccupancyFrontiers(*belief.occupancy, query.start, query.FromStart(),
                               belief.options->frontier.min_occupancy_cell_count, query.stop),
        judged);
  return judged;
}

FrontierGoals FindFrontierGoals(const GoalQuery& query) {
  FrontierGoals found;
  for (JudgedFrontier& frontier : JudgeFrontiers(query)) {
    if (frontier.rejection) {
      found.rejected.push_back(*std::move(frontier.rejection));
    } else {
      const bool is_gas = frontier.goal.kind == GoalKind::kGasFrontier;
      (is_gas ? found.gas : found.occupancy).push_back({frontier.goal, *frontier.travel_m});
    }
  }
  return found;
}

}  // namespace plumescout
