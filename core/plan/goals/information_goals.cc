// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/information_goals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/frontier/gas_frontier.h"
#include "core/grid/padded.h"
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

// What each of these cells can still tell, nats; 0 off free cells. A raster of them alone.
Grid<float> LeftToTell(const Belief& belief, const CellRect& cells, const StopFn& stop) {
  const MissionOptions& mission = *belief.options;
  const std::vector<float> relevance = Relevance(belief, cells, stop);
  const double observed_ppm2 = ObservedVariance_ppm2(mission.frontier, mission.gas);
  const auto most_ppm2 = static_cast<float>(OpenLatticeVariance_ppm2(mission.gas));
  // How often what is known holds what counts as done. NaN where nothing is.
  const auto times_done = [&](float known_ppm2, float relevant) {
    const auto variance_ppm2 = static_cast<double>(std::min(known_ppm2, most_ppm2));
    const double sure = std::min(1.0, static_cast<double>(relevant));
    return variance_ppm2 / (observed_ppm2 * (1.0 - (1.0 - kDoneShare) * sure));
  };
  GridGeometry geometry = belief.geometry();
  geometry.width = cells.width();
  geometry.height = cells.height();
  Grid<float> left(geometry, 0.0F, stop);
  const auto width = static_cast<std::size_t>(cells.width());
  std::vector<double> times(width);
  const float* relevant = relevance.data();
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const float* const variance_ppm2 = GridRow(*belief.gas_variance_ppm2, y) + cells.min.x;
    float* const row = GridRow(left, y - cells.min.y);
    for (std::size_t x = 0; x < width; ++x) times[x] = times_done(variance_ppm2[x], relevant[x]);
    for (std::size_t x = 0; x < width; ++x) {
      constexpr double kEntropyShare = 0.5;
      if (!(times[x] > 1.0)) continue;
      row[x] = relevant[x] * static_cast<float>(kEntropyShare * std::log(times[x]));
    }
    relevant += width;
  });
  return left;
}

struct Spot {
  double merit = 0.0;
  std::size_t index = 0;
};

bool IsWorse(const Spot& a, const Spot& b) {
  return a.merit != b.merit ? a.merit < b.merit : a.index > b.index;
}

// What each cell is worth driving to; 0 where no goal may be. Of no use once query.stop says so.
class Merits {
 public:
  Merits(const GoalQuery& query, const OwnArea* area)
      : query_(query),
        area_(area),
        from_start_(query.FromStart()),
        left_(
            LeftToTell(query.ahead != nullptr ? *query.ahead : query.belief, cells(), query.stop)),
        around_(WindowSums(left_, ReachCells(), query.stop)),
        closed_(left_.geometry(), 0),
        nearest_m_(std::max(query.options.min_goal_distance_m,
                            query.options.speed_mps / query.options.reading_rate_hz)) {}

  const GridGeometry& geometry() const { return query_.belief.geometry(); }
  // All that can be reached, and all that is free.
  const CellRect& cells() const { return from_start_.cells(); }

  // The best of a row, the first of several; of no merit if there is none.
  Spot BestOf(int y) const {
    constexpr double kRounding = 1.0 + 1e-9;  // more than that of a quotient
    const int row = y - cells().min.y;
    const float* const left = GridRow(left_, row);
    const float* const around = GridRow(around_, row);
    const std::uint8_t* const closed = GridRow(closed_, row);
    const std::uint8_t* const reachable = GridRow(query_.reachable, y) + cells().min.x;
    const int first = from_start_.IndexOf({cells().min.x, y});
    Spot best;
    for (int x = 0; x < cells().width(); ++x) {
      if (reachable[x] == 0 || !(left[x] > 0.0F) || closed[x] != 0) continue;
      const double travel_m = from_start_.TravelAt(first + x);
      const auto nats = static_cast<double>(around[x]);
      if (nats * kRounding < best.merit * (kErrand_m + travel_m)) continue;
      const Cell cell{cells().min.x + x, y};
      const double merit = At(cell);
      if (merit > best.merit) best = {merit, geometry().Index(cell)};
    }
    return best;
  }

  bool IsClosed(Cell cell) const { return closed_[Inside(cell)] != 0; }

  // Leaves no goal nearer to `place` than kApart_m. Returns whether there might have been one.
  bool Clear(Point2 place) {
    const int reach = 1 + static_cast<int>(std::ceil(kApart_m / geometry().resolution_m));
    const CellRect near =
        CellRect::Sized(geometry().CellAt(place), 1, 1).Grown(reach).Within(cells());
    bool found = false;
    for (int y = near.min.y; y < near.end.y; ++y) {
      for (int x = near.min.x; x < near.end.x; ++x) {
        if (Distance_m(place, geometry().Center({x, y})) >= kApart_m) continue;
        found = found || At({x, y}) > 0.0;
        closed_[Inside({x, y})] = 1;
      }
    }
    return found;
  }

 private:
  int ReachCells() const {
    return static_cast<int>(std::lround(kWindowReach_m / geometry().resolution_m));
  }
  Cell Inside(Cell cell) const { return {cell.x - cells().min.x, cell.y - cells().min.y}; }
  double At(Cell cell) const {
    const Cell inside = Inside(cell);
    if (query_.reachable[cell] == 0 || !(left_[inside] > 0.0F) || closed_[inside] != 0) return 0.0;
    const double travel_m = from_start_.Travel(cell);
    if (travel_m < nearest_m_ || (area_ != nullptr && !area_->Has(cell))) return 0.0;
    return static_cast<double>(around_[inside]) / (kErrand_m + travel_m);
  }

  const GoalQuery& query_;
  const OwnArea* const area_;  // null: goals may be anywhere
  const TravelFromStarts& from_start_;
  // Of cells() alone.
  const Grid<float> left_;
  const Grid<float> around_;
  Grid<std::uint8_t> closed_;
  const double nearest_m_;
};

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

void ClearPlacesInMemory(const GoalQuery& query, Merits& merits,
                         std::vector<RejectedGoal>& rejected) {
  for (Goal& place : PlacesInMemory(query.belief)) {
    place.cell = merits.geometry().CellAt(place.position);  // the map may have grown since
    std::optional<RejectedGoal> rejection = RejectedByMemory(query, place);
    if (rejection && merits.Clear(place.position)) rejected.push_back(*std::move(rejection));
  }
}

// The best of each row that has any.
std::vector<Spot> BestOfRows(const Merits& merits, const StopFn& stop) {
  std::vector<Spot> rows;
  const CellRect& cells = merits.cells();
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const Spot best = merits.BestOf(y);
    if (best.merit > 0.0) rows.push_back(best);
  });
  return rows;
}

Goal GoalAt(Cell cell, const GridGeometry& geometry) {
  Goal goal;
  goal.kind = GoalKind::kInformation;
  goal.cell = cell;
  goal.position = geometry.Center(goal.cell);
  goal.centroid = goal.position;
  return goal;
}

}  // namespace

std::vector<Goal> InformationGoals(const GoalQuery& query, std::vector<RejectedGoal>& rejected,
                                   const OwnArea* area) {
  std::vector<Goal> goals;
  if (query.belief.gas_counters.readings == 0) return goals;
  Merits merits(query, area);
  if (Stops(query.stop)) return goals;
  ClearPlacesInMemory(query, merits, rejected);
  std::vector<Spot> rows = BestOfRows(merits, query.stop);
  std::make_heap(rows.begin(), rows.end(), IsWorse);
  while (!rows.empty() && goals.size() < kMaxGoals && !Stops(query.stop)) {
    std::pop_heap(rows.begin(), rows.end(), IsWorse);
    const Cell best = merits.geometry().CellAtIndex(rows.back().index);
    rows.pop_back();
    if (!merits.IsClosed(best)) {
      goals.push_back(GoalAt(best, merits.geometry()));
      merits.Clear(goals.back().position);
    }  // else too near to one that is taken
    const Spot next = merits.BestOf(best.y);
    if (!(next.merit > 0.0)) continue;
    rows.push_back(next);
    std::push_heap(rows.begin(), rows.end(), IsWorse);
  }
  return goals;
}

}  // namespace plumescout
