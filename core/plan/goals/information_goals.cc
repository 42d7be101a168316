// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/information_goals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/frontier/gas_frontier.h"
#include "core/grid/grid_search.h"
#include "core/grid/window_sums.h"
#include "core/plan/goals/frontier_goals.h"
#include "core/plan/relevance.h"

namespace plumescout {
namespace {

constexpr std::size_t kMaxGoals = 12;
constexpr double kApart_m = 1.5;
constexpr double kWindowReach_m = 0.5;
constexpr double kErrand_m = 4.0;
// Variance that counts as done where there surely is gas, over that of clean air.
constexpr double kDoneShare = 0.5;

// What each cell can still tell, nats; 0 off free cells.
Grid<float> LeftToTell(const Belief& belief) {
  const MissionOptions& mission = *belief.options;
  const std::vector<float> relevance = Relevance(*belief.gas_mean_ppm, mission);
  const double observed_ppm2 = ObservedVariance_ppm2(mission.frontier, mission.gas);
  const auto most_ppm2 = static_cast<float>(OpenLatticeVariance_ppm2(mission.gas));
  Grid<float> left(belief.geometry(), 0.0F);
  for (std::size_t i = 0; i < left.size(); ++i) {
    const float variance_ppm2 = std::min((*belief.gas_variance_ppm2)[i], most_ppm2);
    if (!(variance_ppm2 > 0.0F)) continue;
    const double sure = std::min(1.0, static_cast<double>(relevance[i]));
    const double done_ppm2 = observed_ppm2 * (1.0 - (1.0 - kDoneShare) * sure);
    constexpr double kEntropyShare = 0.5;
    const double nats = kEntropyShare * std::log(static_cast<double>(variance_ppm2) / done_ppm2);
    left[i] = relevance[i] * static_cast<float>(std::max(0.0, nats));
  }
  return left;
}

struct Spot {
  double merit;
  std::size_t index;
};

// Best first.
std::vector<Spot> RankSpots(const GoalQuery& query) {
  const GridGeometry& geometry = query.belief.geometry();
  const int reach_cells = static_cast<int>(std::lround(kWindowReach_m / geometry.resolution_m));
  const Grid<float> left = WindowSums(LeftToTell(query.belief), reach_cells);
  const Grid<double> travel_m = TravelDistances_m(query.reachable, std::vector<Cell>{query.start});
  const double reading_m = query.options.speed_mps / query.options.reading_rate_hz;
  const double nearest_m = std::max(query.options.min_goal_distance_m, reading_m);
  std::vector<Spot> spots;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (query.reachable[i] == 0 || !(left[i] > 0.0F) || travel_m[i] < nearest_m) continue;
    spots.push_back({static_cast<double>(left[i]) / (kErrand_m + travel_m[i]), i});
  }
  std::sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) {
    return a.merit != b.merit ? a.merit > b.merit : a.index < b.index;
  });
  return spots;
}

}  // namespace

std::vector<Goal> InformationGoals(const GoalQuery& query) {
  std::vector<Goal> goals;
  if (query.belief.gas_counters.readings == 0) return goals;
  const GridGeometry& geometry = query.belief.geometry();
  for (const Spot& spot : RankSpots(query)) {
    if (goals.size() == kMaxGoals) break;
    Goal goal;
    goal.kind = GoalKind::kInformation;
    goal.cell = geometry.CellAtIndex(spot.index);
    goal.position = geometry.Center(goal.cell);
    goal.centroid = goal.position;
    const bool crowded = std::any_of(goals.begin(), goals.end(), [&](const Goal& taken) {
      return Distance_m(taken.position, goal.position) < kApart_m;
    });
    if (!crowded && !RejectedByMemory(query, goal)) goals.push_back(goal);
  }
  return goals;
}

}  // namespace plumescout
