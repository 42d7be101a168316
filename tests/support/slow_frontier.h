// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "core/grid/neighbours.h"
#include "core/types/cell_state.h"
#include "core/types/frontier.h"
#include "core/types/grid.h"
#include "core/types/rng.h"

namespace plumescout::testing {

// Frontiers by their definitions, cell by cell, without any wavefront.
using Cluster = std::set<Cell>;

template <typename Predicate>
bool AnyNeighbour(Cell cell, Predicate&& predicate) {
  return std::any_of(kNeighbours8.begin(), kNeighbours8.end(),
                     [&](Cell offset) { return predicate(Shifted(cell, offset)); });
}

// The maximal 8-connected subsets of `cells`: takes any cell and all that hangs on it, until none
// is left.
inline std::set<Cluster> MaximalClusters(std::set<Cell> cells) {
  std::set<Cluster> clusters;
  while (!cells.empty()) {
    Cluster cluster;
    std::vector<Cell> open = {*cells.begin()};
    cells.erase(cells.begin());
    while (!open.empty()) {
      const Cell cell = open.back();
      open.pop_back();
      cluster.insert(cell);
      for (const Cell offset : kNeighbours8) {
        if (cells.erase(Shifted(cell, offset)) > 0) open.push_back(Shifted(cell, offset));
      }
    }
    clusters.insert(cluster);
  }
  return clusters;
}

// Each cell free, unknown or occupied, in patches about `patch` cells wide.
inline Grid<CellState> RandomStates(int width, int height, int patch, Rng& rng) {
  Grid<CellState> states(GridGeometry{-1.6, 3.2, 0.1, width, height}, CellState::kFree);
  const int patches = width * height / (3 * patch * patch);
  for (int i = 0; i < patches; ++i) {
    const Cell corner = states.geometry().CellAtIndex(rng.Below(states.size()));
    const CellState state = rng.Below(3) == 0   ? CellState::kOccupied
                            : rng.Below(2) == 0 ? CellState::kFree
                                                : CellState::kUnknown;
    const int right = corner.x + static_cast<int>(rng.Below(static_cast<std::uint64_t>(patch))) + 1;
    const int top = corner.y + static_cast<int>(rng.Below(static_cast<std::uint64_t>(patch))) + 1;
    for (int y = corner.y; y < std::min(top, height); ++y) {
      for (int x = corner.x; x < std::min(right, width); ++x) states[Cell{x, y}] = state;
    }
  }
  return states;
}

inline std::set<Cluster> ClustersOf(const std::vector<Frontier>& frontiers) {
  std::set<Cluster> clusters;
  for (const Frontier& frontier : frontiers) {
    clusters.insert(Cluster(frontier.cells.begin(), frontier.cells.end()));
  }
  return clusters;
}

}  // namespace plumescout::testing
