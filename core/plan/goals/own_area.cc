// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/own_area.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/frontier/gas_frontier.h"
#include "core/grid/escape.h"
#include "core/grid/padded.h"

namespace plumescout {
namespace {

// An edge of the unseen hides at least as much as a strip of this depth.
constexpr double kBehindEdge_m = 2.0;
// Cells that are looked at; more are thinned out.
constexpr double kMostCells = 4096.0;
constexpr int kRounds = 40;
constexpr double kDecay = 0.93;  // of the steps, from round to round

// What there is to do, piece by piece, and how far each robot has to drive to it.
struct Work {
  std::vector<double> amounts_m2;
  std::vector<double> ways_m;  // by piece, then by robot
};

bool SharesWork(const RobotRecord& record) {
  return record.state.has_pose && !record.state.silent && !IsSentHome(record);
}

std::size_t Nearest(const double* ways_m, const std::vector<double>& handicaps_m) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < handicaps_m.size(); ++i) {
    if (ways_m[i] + handicaps_m[i] < ways_m[nearest] + handicaps_m[nearest]) nearest = i;
  }
  return nearest;
}

std::vector<double> Loads_m2(const Work& work, const std::vector<double>& handicaps_m) {
  std::vector<double> loads_m2(handicaps_m.size(), 0.0);
  const double* ways_m = work.ways_m.data();
  for (const double amount_m2 : work.amounts_m2) {
    loads_m2[Nearest(ways_m, handicaps_m)] += amount_m2;
    ways_m += handicaps_m.size();
  }
  return loads_m2;
}

// Those with which the most that one robot has to do is least, of those tried: who has more than
// the mean gets a greater handicap, in steps that begin with a share of the ways and get shorter.
std::vector<double> BalancingHandicaps_m(const Work& work, std::size_t robots, const StopFn& stop) {
  std::vector<double> handicaps_m(robots, 0.0);
  const double total_m2 = std::accumulate(work.amounts_m2.begin(), work.amounts_m2.end(), 0.0);
  if (!(total_m2 > 0.0)) return handicaps_m;
  const double mean_m2 = total_m2 / static_cast<double>(robots);
  constexpr double kFirstStepShare = 0.5;  // of the mean way
  double step_m = kFirstStepShare * std::accumulate(work.ways_m.begin(), work.ways_m.end(), 0.0) /
                  static_cast<double>(work.ways_m.size());
  std::vector<double> best_m = handicaps_m;
  double least_m2 = total_m2;
  for (int round = 0; round < kRounds && !Stops(stop); ++round, step_m *= kDecay) {
    const std::vector<double> loads_m2 = Loads_m2(work, handicaps_m);
    const double most_m2 = *std::max_element(loads_m2.begin(), loads_m2.end());
    if (most_m2 < least_m2) {
      least_m2 = most_m2;
      best_m = handicaps_m;
    }
    for (std::size_t i = 0; i < robots; ++i) {
      handicaps_m[i] += step_m * std::min(1.0, loads_m2[i] / mean_m2 - 1.0);
    }
  }
  return best_m;
}

// Calls visit(cell, area_m2) for cells that can be reached and whose gas is not observed, each for
// those around it that are left out.
template <typename Visit>
void ForEachUnobserved(const GoalQuery& query, const CellRect& cells, const Visit& visit) {
  const MissionOptions& mission = *query.belief.options;
  const double observed_ppm2 = ObservedVariance_ppm2(mission.frontier, mission.gas);
  const auto stride = static_cast<int>(
      std::ceil(std::sqrt(std::max(1.0, static_cast<double>(cells.size()) / kMostCells))));
  const double edge_m = stride * query.belief.geometry().resolution_m;
  for (int y = cells.min.y; y < cells.end.y; y += stride) {
    const std::uint8_t* const reachable = GridRow(query.reachable, y);
    const float* const variance_ppm2 = GridRow(*query.belief.gas_variance_ppm2, y);
    for (int x = cells.min.x; x < cells.end.x; x += stride) {
      // NaN: nothing is known.
      const bool observed = static_cast<double>(variance_ppm2[x]) <= observed_ppm2;
      if (reachable[x] != 0 && !observed) visit(Cell{x, y}, edge_m * edge_m);
    }
  }
}

// Calls visit(cell, area_m2) for edges of the unseen that somebody is to go to.
template <typename Visit>
void ForEachEdge(const GoalQuery& query, const FrontierGoals& frontiers, const Visit& visit) {
  const double depth_m2 = kBehindEdge_m * query.belief.geometry().resolution_m;
  const auto tell = [&](const Goal& goal) {
    if (query.reachable.At(goal.cell, 0) != 0) visit(goal.cell, depth_m2 * goal.frontier_cells);
  };
  for (const OfferedGoal& offered : frontiers.occupancy) tell(offered.goal);
  for (const RejectedGoal& rejected : frontiers.rejected) {
    const bool is_claimed = rejected.reason == RejectionReason::kClaimed &&
                            rejected.goal.kind == GoalKind::kOccupancyFrontier;
    if (is_claimed) tell(rejected.goal);
  }
}

}  // namespace

std::optional<OwnArea> OwnArea::Find(const GoalQuery& query, const FrontierGoals& frontiers) {
  std::vector<Sharer> sharers;
  std::size_t self = 0;
  for (const auto& [id, record] : query.belief.robots) {
    if (id == query.robot.state.id) {
      self = sharers.size();
      sharers.push_back({id, query.FromStart()});
      continue;
    }
    if (!SharesWork(record) || Stops(query.stop)) continue;
    const Cell cell = query.belief.geometry().CellAt(record.state.pose.position());
    const std::vector<Cell> way = EscapePath(*query.belief.occupancy, query.reachable, cell);
    if (!way.empty()) sharers.push_back({id, TravelFrom(query, {{way.back()}})});
  }
  if (sharers.size() < 2) return std::nullopt;
  OwnArea area(std::move(sharers), self);
  area.Balance(query, frontiers);
  return area;
}

OwnArea::OwnArea(std::vector<Sharer> sharers, std::size_t self)
    : sharers_(std::move(sharers)), self_(self) {}

void OwnArea::Balance(const GoalQuery& query, const FrontierGoals& frontiers) {
  Work work;
  const auto add = [&](Cell cell, double amount_m2) {
    work.amounts_m2.push_back(amount_m2);
    for (const Sharer& sharer : sharers_) work.ways_m.push_back(sharer.from_robot.Travel(cell));
  };
  ForEachUnobserved(query, query.FromStart().cells(), add);
  ForEachEdge(query, frontiers, add);
  const std::vector<double> handicaps_m = BalancingHandicaps_m(work, sharers_.size(), query.stop);
  for (std::size_t i = 0; i < sharers_.size(); ++i) sharers_[i].handicap_m = handicaps_m[i];
}

std::size_t OwnArea::OwnerIndex(Cell cell) const {
  std::size_t owner = 0;
  double least_m = sharers_[0].from_robot.Travel(cell) + sharers_[0].handicap_m;
  for (std::size_t i = 1; i < sharers_.size(); ++i) {
    const double way_m = sharers_[i].from_robot.Travel(cell) + sharers_[i].handicap_m;
    if (way_m >= least_m) continue;
    owner = i;
    least_m = way_m;
  }
  return owner;
}

}  // namespace plumescout
