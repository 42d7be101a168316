// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/grid_oracle.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace plumescout::lab {
namespace {

// Steps to all directions that the first `connectivity` of {1,0}, {1,1}, {2,1}, {3,1}, {3,2} make
// with their mirror images.
std::vector<Cell> Steps(int connectivity) {
  constexpr int kEight = 8;
  constexpr int kSixteen = 16;
  std::vector<Cell> octant = {{1, 0}, {1, 1}};
  if (connectivity > kEight) octant.push_back({2, 1});
  if (connectivity > kSixteen) octant.insert(octant.end(), {{3, 1}, {3, 2}});
  std::vector<Cell> steps;
  for (const Cell s : octant) {
    steps.insert(steps.end(), {{s.x, s.y}, {-s.y, s.x}, {-s.x, -s.y}, {s.y, -s.x}});
    if (s.x == s.y || s.y == 0) continue;
    steps.insert(steps.end(), {{s.y, s.x}, {-s.x, s.y}, {-s.y, -s.x}, {s.x, -s.y}});
  }
  return steps;
}

}  // namespace

Grid<double> OracleCosts(const EdgeCost& cost, Cell start, int connectivity) {
  using Entry = std::pair<double, std::size_t>;
  const GridGeometry& geometry = cost.geometry();
  const std::vector<Cell> steps = Steps(connectivity);
  Grid<double> costs(geometry, std::numeric_limits<double>::infinity());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  costs[start] = 0.0;
  queue.emplace(0.0, geometry.Index(start));
  while (!queue.empty()) {
    const auto [so_far, index] = queue.top();
    queue.pop();
    if (so_far > costs[index]) continue;
    const Cell from = geometry.CellAtIndex(index);
    for (const Cell step : steps) {
      const Cell to{from.x + step.x, from.y + step.y};
      if (!geometry.Contains(to)) continue;
      const double via = so_far + cost(geometry.Center(from), geometry.Center(to));
      if (via < costs[to]) {
        costs[to] = via;
        queue.emplace(via, geometry.Index(to));
      }
    }
  }
  return costs;
}

}  // namespace plumescout::lab
