// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/cost_search.h"

#include <algorithm>
#include <limits>

#include "core/grid/neighbours.h"
#include "core/plan/paths/shortcut.h"

namespace plumescout {
namespace {

constexpr float kBlockedPenalty = std::numeric_limits<float>::infinity();
constexpr double kUnreached = std::numeric_limits<double>::infinity();
constexpr std::int8_t kStart = -1;
constexpr int kVisitsBetweenStops = 512;  // some tens of microseconds

}  // namespace

CostSearch::CostSearch(const EdgeCost& cost, const CellRect& cells, const StopFn& stop)
    : cost_(cost),
      penalty_(cells, kBlockedPenalty, kBlockedPenalty, stop),
      g_(cells, kUnreached, kUnreached, stop),
      from_(cells, kStart, kStart, stop),
      offsets_(penalty_.NeighbourOffsets()),
      levels_per_cost_(kBucketsPerStep / cost.GridStep(1.0F, 1.0F, kDiagonalStep_cells)) {
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    std::copy_n(GridRow(cost.information().penalty, y) + cells.min.x, cells.width(),
                penalty_.Row(y));
  });
}

bool CostSearch::Run(Cell start, const std::vector<Cell>& goals, const StopFn& stop) {
  if (stop()) return false;
  Reach(penalty_.IndexOf(start), kStart, 0.0);
  int visits = 0;
  for (; waiting_ > 0 && !Settled(goals); ++level_) {
    std::vector<Entry>& bucket = BucketOf(level_);
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const Entry entry = bucket[i];
      --waiting_;
      if (entry.g == g_[entry.cell]) ReachNeighbours(entry);
      if (++visits % kVisitsBetweenStops == 0 && stop()) return false;
    }
    bucket.clear();
  }
  return true;
}

// Whether no goal can become cheaper: all lie in buckets done with.
bool CostSearch::Settled(const std::vector<Cell>& goals) const {
  return std::all_of(goals.begin(), goals.end(), [this](Cell goal) {
    const double g = g_[g_.IndexOf(goal)];
    return g < kUnreached && LevelOf(g) < level_;
  });
}

void CostSearch::Reach(int cell, std::int8_t from, double g) {
  if (!(g < g_[cell])) return;
  g_[cell] = g;
  from_[cell] = from;
  BucketOf(std::max(LevelOf(g), level_)).push_back({cell, g});
  ++waiting_;
}

void CostSearch::ReachNeighbours(const Entry& from) {
  const float penalty = penalty_[from.cell];
  std::array<bool, 4> open{};
  for (std::size_t k = 0; k < kNeighbours8.size(); ++k) {
    const int to = from.cell + offsets_[k];
    const bool passable = penalty_[to] != kBlockedPenalty;
    const bool diagonal = k >= 4;
    if (!diagonal) open[k] = passable;
    // Diagonal k lies between the straight steps k - 4 and k - 3.
    if (!passable || (diagonal && !(open[k - 4] && open[(k - 3) % 4]))) continue;
    Reach(to, static_cast<std::int8_t>(k),
          from.g + cost_.GridStep(penalty, penalty_[to],
                                  diagonal ? kDiagonalStep_cells : kStraightStep_cells));
  }
}

std::vector<Point2> CostSearch::WayTo(Cell goal, Point2 start) const {
  if (from_.empty() || g_[g_.IndexOf(goal)] == kUnreached) return {};
  std::vector<Point2> way;
  for (int cell = g_.IndexOf(goal);; cell -= offsets_[static_cast<std::size_t>(from_[cell])]) {
    way.push_back(cost_.geometry().Center(g_.CellAt(cell)));
    if (from_[cell] == kStart) break;
  }
  if (way.back() != start) way.push_back(start);
  std::reverse(way.begin(), way.end());
  return cost_.CountsVerticesOnly() ? way : WithoutCollinear(way);
}

}  // namespace plumescout
