// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/information_goals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/frontier/gas_frontier.h"
#include "core/grid/grid_search.h"
#include "core/grid/window_sums.h"
#include "core/plan/cost/relevance.h"
#include "core/plan/goals/frontier_goals.h"

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

bool IsWorse(const Spot& a, const Spot& b) {
  return a.merit != b.merit ? a.merit < b.merit : a.index > b.index;
}

// A heap, the best on top: of some million spots a few thousand are looked at.
std::vector<Spot> FindSpots(const GoalQuery& query) {
  const GridGeometry& geometry = query.belief.geometry();
  const int reach_cells = static_cast<int>(std::lround(kWindowReach_m / geometry.resolution_m));
  const Grid<float> left = LeftToTell(query.belief);
  const Grid<float> around = WindowSums(left, reach_cells);
  const Grid<double> travel_m = TravelDistances_m(query.reachable, std::vector<Cell>{query.start});
  const double reading_m = query.options.speed_mps / query.options.reading_rate_hz;
  const double nearest_m = std::max(query.options.min_goal_distance_m, reading_m);
  std::vector<Spot> spots;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (query.reachable[i] == 0 || !(left[i] > 0.0F) || travel_m[i] < nearest_m) continue;
    spots.push_back({static_cast<double>(around[i]) / (kErrand_m + travel_m[i]), i});
  }
  std::make_heap(spots.begin(), spots.end(), IsWorse);
  return spots;
}

Goal GoalAt(std::size_t index, const GridGeometry& geometry) {
  Goal goal;
  goal.kind = GoalKind::kInformation;
  goal.cell = geometry.CellAtIndex(index);
  goal.position = geometry.Center(goal.cell);
  goal.centroid = goal.position;
  return goal;
}

}  // namespace

std::vector<Goal> InformationGoals(const GoalQuery& query, std::vector<RejectedGoal>& rejected) {
  std::vector<Goal> goals;
  if (query.belief.gas_counters.readings == 0) return goals;
  std::vector<Spot> spots = FindSpots(query);
  std::vector<Point2> taken;
  while (!spots.empty() && goals.size() < kMaxGoals) {
    std::pop_heap(spots.begin(), spots.end(), IsWorse);
    const Goal goal = GoalAt(spots.back().index, query.belief.geometry());
    spots.pop_back();
    const bool crowded = std::any_of(taken.begin(), taken.end(), [&](Point2 place) {
      return Distance_m(place, goal.position) < kApart_m;
    });
    if (crowded) continue;
    taken.push_back(goal.position);
    if (std::optional<RejectedGoal> rejection = RejectedByMemory(query, goal)) {
      rejected.push_back(*std::move(rejection));
    } else {
      goals.push_back(goal);
    }
  }
  return goals;
}

}  // namespace plumescout
