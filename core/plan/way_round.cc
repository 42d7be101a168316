// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/way_round.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/plan/paths/grid_exact.h"
#include "core/plan/plan_start.h"
#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"

namespace plumescout {
namespace {

// How long a way takes, with the wait before it; infinite if there is none that is clear.
double Arrival_s(const Traffic& traffic, const Candidate& candidate, const SearchedWays& ways) {
  const Trajectory trajectory =
      TimeTrajectory(candidate.path, ways.departure.yaw_rad, ways.options);
  const std::optional<double> wait_s = traffic.LeastWait_s(trajectory);
  return wait_s ? candidate.duration_s + *wait_s : std::numeric_limits<double>::infinity();
}

// Without the cells that are nearer to where another robot will be than one has to keep, unless it
// is gone from there before the robot can come. Where the robot stands too near already it is
// without those that are nearer still.
InformationMap KeptClear(const Traffic& traffic, const SearchedWays& ways) {
  InformationMap information = ways.problem.cost.information();
  const GridGeometry& geometry = information.penalty.geometry();
  for (const Traffic::Hold& hold : traffic.Holds()) {
    const double way_m = Distance_m(hold.place, ways.problem.start);
    if ((way_m - hold.apart_m) / ways.options.speed_mps > hold.until_s) continue;
    const double reach_m = std::min(hold.apart_m, way_m);
    const Cell low = geometry.CellAt({hold.place.x_m - reach_m, hold.place.y_m - reach_m});
    const Cell high = geometry.CellAt({hold.place.x_m + reach_m, hold.place.y_m + reach_m});
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const Cell cell{x, y};
        if (!geometry.Contains(cell)) continue;
        if (Distance_m(geometry.Center(cell), hold.place) >= reach_m) continue;
        information.penalty[cell] = std::numeric_limits<float>::infinity();
      }
    }
  }
  return information;
}

}  // namespace

void LeadRound(const SearchedWays& ways, Plan& plan) {
  if (!ways.options.yield_to_robots || ways.belief.robots.size() < 2) return;
  const Traffic traffic(ways.belief.robots, plan.robot, ways.options.robot_clearance_m,
                        ways.belief.sample_time_ns);
  std::vector<Goal> goals;
  std::vector<std::size_t> stand;  // which candidates
  std::vector<double> arrivals_s;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const Candidate& candidate = plan.candidates[i];
    const double arrival_s = Arrival_s(traffic, candidate, ways);
    if (arrival_s < candidate.duration_s + kWorthAWayRound_s) continue;
    goals.push_back(candidate.goal);
    stand.push_back(i);
    arrivals_s.push_back(arrival_s);
  }
  if (goals.empty()) return;
  const InformationMap clear = KeptClear(traffic, ways);
  const EdgeCost cost(clear, ways.options.cost, ways.options.alpha_per_m);
  const PathResult result = GridExactPlanner().FindPaths(
      {cost, ways.problem.reachable, ways.problem.start, goals, plan.seed,
       ways.problem.max_edge_evaluations, ways.problem.stop});
  for (std::size_t k = 0; k < stand.size(); ++k) {
    if (!result.paths[k]) continue;
    Candidate round =
        MakeCandidate(goals[k], result.paths[k]->vertices, result.paths[k]->source, ways.judge);
    PutBefore(ways.departure.way_out, round);
    round.duration_s = TimeTrajectory(round.path, ways.departure.yaw_rad, ways.options).duration_s;
    if (Arrival_s(traffic, round, ways) < arrivals_s[k]) {
      plan.candidates[stand[k]] = std::move(round);
    }
  }
}

}  // namespace plumescout
