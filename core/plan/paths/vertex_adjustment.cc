// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/vertex_adjustment.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "core/grid/neighbours.h"

namespace plumescout {
namespace {

constexpr std::array<int, 3> kSteps_cells = {4, 2, 1};
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr int kMaxSweeps = 8;  // over all vertices with steps of one length
// A move must save this share of its two edges: less is rounding, which could go round in circles.
constexpr double kLeastSaving = 1e-9;

class Adjustment {
 public:
  Adjustment(EdgePrices& prices, const StopFn& stop, ShortcutPath& path)
      : edges_(prices),
        cost_(prices.cost()),
        stop_(stop),
        path_(path),
        moved_(path.vertices.size(), 1) {
    for (std::size_t i = 1; i < path.vertices.size(); ++i) {
      prices_.push_back(Price(path.vertices[i - 1], path.vertices[i], kUnlimited));
    }
  }

  void Run() {
    for (const int step : kSteps_cells) {
      std::fill(moved_.begin(), moved_.end(), char{1});
      for (int sweep = 0; sweep < kMaxSweeps && Sweep(step); ++sweep) {
      }
    }
    path_.cost = std::accumulate(prices_.begin(), prices_.end(), 0.0);
  }

 private:
  // Tries to move each vertex that has a neighbour, or is one itself, which moved in the last
  // sweep. False if none was moved.
  bool Sweep(int step) {
    bool any = false;
    char previous_moved = 0;  // in the last sweep, or just now
    for (std::size_t i = 1; i + 1 < path_.vertices.size(); ++i) {
      const char had_moved = moved_[i];
      const bool worth_it = previous_moved != 0 || had_moved != 0 || moved_[i + 1] != 0;
      if (worth_it && stop_()) return false;
      moved_[i] = worth_it && Move(i, step) ? 1 : 0;
      any = any || moved_[i] != 0;
      previous_moved = had_moved | moved_[i];
    }
    return any;
  }

  // Moves vertex i to the best place one step away, if that is better than its own.
  bool Move(std::size_t i, int step) {
    const GridGeometry& geometry = cost_.geometry();
    const Point2 before = path_.vertices[i - 1];
    const Point2 after = path_.vertices[i + 1];
    const Cell cell = geometry.CellAt(path_.vertices[i]);
    double best = (prices_[i - 1] + prices_[i]) * (1.0 - kLeastSaving);
    bool found = false;
    for (const Cell offset : kNeighbours8) {
      const Cell to{cell.x + step * offset.x, cell.y + step * offset.y};
      if (!geometry.Contains(to)) continue;
      const Point2 place = geometry.Center(to);
      const double rest = cost_.LowerBound(Distance_m(place, after));
      if (cost_.LowerBound(Distance_m(before, place)) + rest >= best) continue;
      const double first = Price(before, place, best - rest);
      if (first + rest >= best) continue;
      const double second = Price(place, after, best - first);
      if (first + second >= best) continue;
      best = first + second;
      prices_[i - 1] = first;
      prices_[i] = second;
      path_.vertices[i] = place;
      found = true;
    }
    return found;
  }

  double Price(Point2 a, Point2 b, double limit) {
    ++path_.edges_evaluated;
    return edges_.UpTo(a, b, limit);
  }

  EdgePrices& edges_;
  const EdgeCost& cost_;
  const StopFn& stop_;
  ShortcutPath& path_;
  std::vector<char> moved_;     // by vertex, in the last sweep
  std::vector<double> prices_;  // of the edges, by the vertex that they leave
};

}  // namespace

void AdjustVertices(EdgePrices& prices, const StopFn& stop, ShortcutPath& path) {
  Adjustment(prices, stop, path).Run();
}

}  // namespace plumescout
