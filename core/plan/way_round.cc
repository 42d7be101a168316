// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/way_round.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/plan/goals/travel_budget.h"
#include "core/plan/paths/grid_exact.h"
#include "core/plan/plan_start.h"
#include "core/plan/selection/selection.h"
#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

constexpr float kBlocked = std::numeric_limits<float>::infinity();

// A candidate that would have to stand.
struct Standing {
  std::size_t candidate = 0;
  double arrival_s = 0.0;  // with the wait; infinite if no wait does
};

// When a way is at its end, with the wait before it; infinite if there is none that is clear.
double Arrival_s(const Candidate& candidate, std::optional<double> wait_s) {
  return wait_s ? candidate.duration_s + *wait_s : std::numeric_limits<double>::infinity();
}

std::vector<Standing> FindStanding(const Waits& waits, const Plan& plan) {
  std::vector<Standing> standing;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const double arrival_s = Arrival_s(plan.candidates[i], waits.waits_s[i]);
    const bool stands = arrival_s >= plan.candidates[i].duration_s + kWorthAWayRound_s;
    if (stands) standing.push_back({i, arrival_s});
  }
  return standing;
}

// Leaves those that could not be gone, and might be chosen for what they are at the price of their
// own ways.
void KeepRivals(const Waits& waits, const PlanningOptions& options, const Plan& plan,
                std::vector<Standing>& standing) {
  std::vector<Candidate> clear;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    if (waits.waits_s[i]) clear.push_back(plan.candidates[i]);
  }
  const int best = SelectCandidate(clear, options);
  std::erase_if(standing, [&](const Standing& one) {
    return std::isfinite(one.arrival_s) ||
           (best >= 0 && BeatsByMargin(clear[static_cast<std::size_t>(best)],
                                       plan.candidates[one.candidate], options));
  });
}

void BlockDisc(Point2 center, double radius_m, Grid<float>& penalty) {
  const GridGeometry& geometry = penalty.geometry();
  const Cell low = geometry.CellAt({center.x_m - radius_m, center.y_m - radius_m});
  const Cell high = geometry.CellAt({center.x_m + radius_m, center.y_m + radius_m});
  for (int y = std::max(0, low.y); y <= std::min(geometry.height - 1, high.y); ++y) {
    for (int x = std::max(0, low.x); x <= std::min(geometry.width - 1, high.x); ++x) {
      const Cell cell{x, y};
      if (Distance_m(geometry.Center(cell), center) < radius_m) penalty[cell] = kBlocked;
    }
  }
}

// Without the cells that touch where another robot will be, unless it is gone from there before the
// robot can come. Where the robot stands too near already, without those that are nearer still.
// Prices alone.
InformationMap KeptClear(const Traffic& traffic, const SearchedWays& ways) {
  const InformationMap& priced = ways.problem.cost.information();
  InformationMap information{{}, priced.penalty, priced.min_penalty, priced.flat};
  const double half_diagonal_m = information.penalty.geometry().resolution_m / std::sqrt(2.0);
  for (const Traffic::Hold& hold : traffic.Holds()) {
    const double way_m = Distance_m(hold.place, ways.problem.start);
    if ((way_m - hold.apart_m) / ways.query.options.speed_mps > hold.until_s) continue;
    BlockDisc(hold.place, std::min(hold.apart_m + half_diagonal_m, way_m - half_diagonal_m),
              information.penalty);
  }
  return information;
}

// Ways to the goals of those that stand, as candidates.
std::vector<Candidate> FindRounds(const InformationMap& clear, const SearchedWays& ways,
                                  const std::vector<Standing>& standing, Plan& plan) {
  std::vector<Goal> goals;
  for (const Standing& one : standing) {
    const Goal& goal = plan.candidates[one.candidate].goal;
    if (clear.penalty.At(goal.cell, kBlocked) < kBlocked) goals.push_back(goal);
  }
  const std::int64_t most = ways.problem.max_edge_evaluations;
  const std::int64_t left = most - plan.effort.edges_evaluated;
  if (goals.empty() || (most > 0 && left <= 0)) return {};
  const EdgeCost cost(clear, ways.query.options.cost, ways.query.options.alpha_per_m);
  const PathResult result =
      GridExactPlanner().FindPaths({cost, ways.problem.reachable, ways.problem.start, goals,
                                    ways.problem.seed, most > 0 ? left : 0, ways.problem.stop});
  plan.effort.edges_evaluated += result.effort.edges_evaluated;
  std::vector<Candidate> rounds;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const std::optional<FoundPath>& path = result.paths[i];
    if (!path) continue;
    Candidate& round =
        rounds.emplace_back(MakeCandidate(goals[i], path->vertices, path->source, ways.judge));
    PutBefore(ways.departure.way_out, round);
    round.duration_s =
        TimeTrajectory(round.path, ways.departure.yaw_rad, ways.query.options).duration_s;
  }
  return rounds;
}

}  // namespace

void LeadRound(const SearchedWays& ways, Waits& waits, Plan& plan) {
  std::vector<Standing> standing = FindStanding(waits, plan);
  if (ways.query.options.selection_rule != SelectionRule::kInformationRate) {
    KeepRivals(waits, ways.query.options, plan, standing);
  }
  if (standing.empty() || ways.problem.stop()) return;
  Plan rounds;
  rounds.candidates = FindRounds(KeptClear(waits.traffic, ways), ways, standing, plan);
  RejectOverBudget(ways.query, rounds);
  for (Candidate& round : rounds.candidates) {
    for (const Standing& one : standing) {
      Candidate& candidate = plan.candidates[one.candidate];
      if (!(candidate.goal == round.goal)) continue;
      const std::optional<double> wait_s = waits.traffic.LeastWait_s(
          TimeTrajectory(round.path, ways.departure.yaw_rad, ways.query.options));
      if (Arrival_s(round, wait_s) < one.arrival_s) {
        candidate = std::move(round);
        waits.waits_s[one.candidate] = wait_s;
      }
      break;
    }
  }
}

}  // namespace plumescout
