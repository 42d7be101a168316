// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/information_goals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/frontier/gas_frontier.h"
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
  const std::vector<float> relevance = Relevance(belief);
  const double observed_ppm2 = ObservedVariance_ppm2(mission.frontier, mission.gas);
  const auto most_ppm2 = static_cast<float>(OpenLatticeVariance_ppm2(mission.gas));
  Grid<float> left(belief.geometry(), 0.0F);
  for (std::size_t i = 0; i < left.size(); ++i) {
    const float variance_ppm2 = std::min((*belief.gas_variance_ppm2)[i], most_ppm2);
    if (!(variance_ppm2 > 0.0F)) continue;
    const double sure = std::min(1.0, static_cast<double>(relevance[i]));
    const double done_ppm2 = observed_ppm2 * (1.0 - (1.0 - kDoneShare) * sure);
    if (!(static_cast<double>(variance_ppm2) > done_ppm2)) continue;
    constexpr double kEntropyShare = 0.5;
    const double nats = kEntropyShare * std::log(static_cast<double>(variance_ppm2) / done_ppm2);
    left[i] = relevance[i] * static_cast<float>(nats);
  }
  return left;
}

// What each cell is worth driving to; 0 where no goal may be.
Grid<double> Merits(const GoalQuery& query) {
  const GridGeometry& geometry = query.belief.geometry();
  const int reach_cells = static_cast<int>(std::lround(kWindowReach_m / geometry.resolution_m));
  const Grid<float> left = LeftToTell(query.ahead != nullptr ? *query.ahead : query.belief);
  Grid<double> merits(geometry, 0.0);
  if (Stops(query.stop)) return merits;
  const Grid<float> around = WindowSums(left, reach_cells);
  const TravelFromStarts& from_start = query.FromStart();
  const double reading_m = query.options.speed_mps / query.options.reading_rate_hz;
  const double nearest_m = std::max(query.options.min_goal_distance_m, reading_m);
  if (Stops(query.stop)) return merits;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (query.reachable[i] == 0 || !(left[i] > 0.0F)) continue;
    const double travel_m = from_start.Travel(geometry.CellAtIndex(i));
    if (travel_m < nearest_m) continue;
    merits[i] = static_cast<double>(around[i]) / (kErrand_m + travel_m);
  }
  return merits;
}

// Leaves no goal nearer to `place` than kApart_m. Returns whether there might have been one.
bool Clear(Point2 place, Grid<double>& merits) {
  const GridGeometry& geometry = merits.geometry();
  const Cell middle = geometry.CellAt(place);
  const int reach = 1 + static_cast<int>(std::ceil(kApart_m / geometry.resolution_m));
  bool found = false;
  for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
    for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
      const Cell cell{x, y};
      if (!(merits.At(cell, 0.0) > 0.0)) continue;
      if (Distance_m(place, geometry.Center(cell)) >= kApart_m) continue;
      merits[cell] = 0.0;
      found = true;
    }
  }
  return found;
}

// Claims come first, for they keep the mission open: what is set aside beside one may leave out
// nothing more.
std::vector<Goal> PlacesInMemory(const Belief& belief) {
  std::vector<Goal> places;
  for (const GoalClaim& claim : belief.claims) {
    // Who drives about at random does not go there to learn.
    if (claim.goal.kind != GoalKind::kRandomFreeSpace) places.push_back(claim.goal);
  }
  for (const SetAsideGoal& aside : belief.set_aside) {
    // That a goal of another kind led nowhere says nothing of what readings tell.
    if (aside.goal.kind == GoalKind::kInformation) places.push_back(aside.goal);
  }
  return places;
}

void ClearPlacesInMemory(const GoalQuery& query, Grid<double>& merits,
                         std::vector<RejectedGoal>& rejected) {
  for (Goal& place : PlacesInMemory(query.belief)) {
    place.cell = merits.geometry().CellAt(place.position);  // the map may have grown since
    std::optional<RejectedGoal> rejection = RejectedByMemory(query, place);
    if (rejection && Clear(place.position, merits)) rejected.push_back(*std::move(rejection));
  }
}

struct Spot {
  double merit;
  std::size_t index;
};

bool IsWorse(const Spot& a, const Spot& b) {
  return a.merit != b.merit ? a.merit < b.merit : a.index > b.index;
}

// A heap, the best on top: of some million spots a few thousand are looked at.
std::vector<Spot> SpotsOf(const Grid<double>& merits) {
  std::vector<Spot> spots;
  for (std::size_t i = 0; i < merits.size(); ++i) {
    if (merits[i] > 0.0) spots.push_back({merits[i], i});
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
  Grid<double> merits = Merits(query);
  ClearPlacesInMemory(query, merits, rejected);
  std::vector<Spot> spots = SpotsOf(merits);
  while (!spots.empty() && goals.size() < kMaxGoals) {
    std::pop_heap(spots.begin(), spots.end(), IsWorse);
    const std::size_t best = spots.back().index;
    spots.pop_back();
    if (!(merits[best] > 0.0)) continue;  // too near to one that is taken
    goals.push_back(GoalAt(best, merits.geometry()));
    Clear(goals.back().position, merits);
  }
  return goals;
}

}  // namespace plumescout
