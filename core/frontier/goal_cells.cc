// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/goal_cells.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/grid/escape.h"
#include "core/grid/grid_search.h"
#include "core/grid/mask.h"
#include "core/grid/padded.h"

namespace plumescout {
namespace {

Grid<double> TravelFromStarts_m(const Grid<CellState>& states,
                                const Grid<std::uint8_t>& traversable,
                                const std::vector<Cell>& starts) {
  std::vector<SearchSource> sources;
  for (const Cell start : starts) {
    const std::vector<Cell> escape = EscapePath(states, traversable, start);
    if (escape.empty()) continue;
    sources.push_back({escape.back(), PathLength_m(escape, states.geometry().resolution_m)});
  }
  return TravelDistances_m(traversable, sources);
}

Cell Anchor(const Frontier& frontier, const GridGeometry& geometry) {
  const auto distance_m = [&](Cell cell) {
    return Distance_m(geometry.Center(cell), frontier.centroid);
  };
  return *std::min_element(frontier.cells.begin(), frontier.cells.end(), [&](Cell a, Cell b) {
    const double a_m = distance_m(a);
    const double b_m = distance_m(b);
    return a_m != b_m ? a_m < b_m : geometry.Index(a) < geometry.Index(b);
  });
}

// Ways from the reached cells to those beyond: inflated free cells and frontier cells.
class LastBit {
 public:
  LastBit(const Grid<CellState>& states, const Grid<double>& travel_m,
          const std::vector<Frontier>& frontiers)
      : travel_m_(travel_m), zones_(states.geometry(), kBlocked, kBlocked) {
    for (int y = 0; y < states.height(); ++y) {
      const CellState* state = GridRow(states, y);
      const double* travel = GridRow(travel_m, y);
      std::uint8_t* zone = zones_.Row(y);
      for (int x = 0; x < states.width(); ++x) {
        const bool reached = travel[x] < kUnreached_m;
        zone[x] = reached ? kReached : state[x] == CellState::kFree ? kBeyond : kBlocked;
      }
    }
    for (const Frontier& frontier : frontiers) {
      for (const Cell cell : frontier.cells) {
        std::uint8_t& zone = zones_[zones_.IndexOf(cell)];
        if (zone == kBlocked) zone = kBeyond;
      }
    }
    Search();
  }

  // The reached cell nearest to `anchor`; none if there is no way.
  std::vector<Cell> Way(Cell anchor) const {
    if (travel_m_[anchor] < kUnreached_m) return {anchor};
    return ShortestPath(beyond_m_, anchor, Connectivity::kEight);
  }

 private:
  static constexpr std::uint8_t kBlocked = 0;
  static constexpr std::uint8_t kReached = 1;
  static constexpr std::uint8_t kBeyond = 2;

  bool TouchesBeyond(int cell, const std::array<int, 8>& offsets) const {
    return std::any_of(offsets.begin(), offsets.end(),
                       [&](int offset) { return zones_[cell + offset] == kBeyond; });
  }

  // Only the rim of the reached zone takes part, so the cost is that of the cells beyond it.
  void Search() {
    const GridGeometry& geometry = travel_m_.geometry();
    const auto offsets = zones_.NeighbourOffsets();
    Grid<std::uint8_t> open(geometry);
    std::vector<Cell> rim;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Cell cell = geometry.CellAtIndex(i);
      const int index = zones_.IndexOf(cell);
      open[i] = zones_[index] == kBeyond ? 1 : 0;
      if (zones_[index] != kReached || !TouchesBeyond(index, offsets)) continue;
      open[i] = 1;
      rim.push_back(cell);
    }
    beyond_m_ = TravelDistances_m(open, rim, Connectivity::kEight);
  }

  const Grid<double>& travel_m_;
  Padded<std::uint8_t> zones_;
  Grid<double> beyond_m_;
};

}  // namespace

std::vector<Cell> FreeStarts(const Grid<CellState>& states, const std::vector<Cell>& starts) {
  std::vector<Cell> free_starts;
  Grid<std::uint8_t> free;  // made when the first start needs it
  for (const Cell start : starts) {
    if (states.At(start, CellState::kOccupied) == CellState::kFree) {
      free_starts.push_back(start);
      continue;
    }
    if (free.size() == 0) free = MaskOf(states, CellState::kFree);
    const std::vector<Cell> path = EscapePath(states, free, start);
    if (!path.empty()) free_starts.push_back(path.back());
  }
  return free_starts;
}

void FindGoalCells(const Grid<CellState>& states, const Grid<std::uint8_t>& traversable,
                   const std::vector<Cell>& starts, std::vector<Frontier>& frontiers) {
  if (frontiers.empty()) return;
  const Grid<double> travel_m = TravelFromStarts_m(states, traversable, starts);
  const LastBit last_bit(states, travel_m, frontiers);
  for (Frontier& frontier : frontiers) {
    const std::vector<Cell> way = last_bit.Way(Anchor(frontier, states.geometry()));
    frontier.reachable = !way.empty();
    if (!frontier.reachable) continue;
    frontier.goal_cell = way.front();
    frontier.travel_m = travel_m[way.front()];
  }
}

}  // namespace plumescout
