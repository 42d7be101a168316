// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/goal_cells.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/grid/escape.h"
#include "core/grid/grid_search.h"
#include "core/grid/mask.h"
#include "core/grid/padded.h"
#include "core/grid/travel_search.h"

namespace plumescout {
namespace {

// From the rim of what is reached: a few cells of length, so that float is exact enough.
using Search = TravelSearch<float>;

TravelFromStarts SearchFromStarts(const Grid<CellState>& states,
                                  const Grid<std::uint8_t>& traversable,
                                  const std::vector<Cell>& starts) {
  std::vector<SearchSource> sources;
  for (const Cell start : starts) {
    const std::vector<Cell> escape = EscapePath(states, traversable, start);
    if (escape.empty()) continue;
    sources.push_back({escape.back(), PathLength_m(escape, states.geometry().resolution_m)});
  }
  TravelFromStarts search(states.geometry(), Connectivity::kEightNoCornerCut,
                          [&traversable](std::size_t index) { return traversable[index] != 0; });
  search.Run(std::move(sources));
  return search;
}

// Counted in cells times the number of cells: whole numbers, so that ties are ties.
Cell Anchor(const Frontier& frontier, const GridGeometry& geometry) {
  const auto count = static_cast<double>(frontier.cells.size());
  double sum_x = 0.0;
  double sum_y = 0.0;
  for (const Cell cell : frontier.cells) {
    sum_x += cell.x;
    sum_y += cell.y;
  }
  const auto squared_distance = [&](Cell cell) {
    const double dx = count * cell.x - sum_x;
    const double dy = count * cell.y - sum_y;
    return dx * dx + dy * dy;
  };
  Cell anchor = frontier.cells.front();
  double least = squared_distance(anchor);
  for (const Cell cell : frontier.cells) {
    const double squared = squared_distance(cell);
    const bool lower_index = geometry.Index(cell) < geometry.Index(anchor);
    if (squared < least || (squared == least && lower_index)) {
      anchor = cell;
      least = squared;
    }
  }
  return anchor;
}

// A search over the free and the frontier cells that `from_starts` did not reach.
Search BeyondSearch(const Grid<CellState>& states, const std::vector<Frontier>& frontiers,
                    const TravelFromStarts& from_starts, const StopFn& stop) {
  const CellRect& cells = from_starts.cells();
  Search beyond(
      states.geometry(), cells, Connectivity::kEight,
      [&](std::size_t index) { return states[index] == CellState::kFree; }, stop);
  if (Stops(stop)) return beyond;
  for (const Frontier& frontier : frontiers) {
    for (const Cell cell : frontier.cells) beyond.Open(beyond.IndexOf(cell));
  }
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const int begin = beyond.IndexOf({cells.min.x, y});
    for (int cell = begin; cell < begin + cells.width(); ++cell) {
      if (from_starts.IsReached(cell)) beyond.Close(cell);
    }
  });
  return beyond;
}

// Opens to `beyond` the reached cells beside its own: only they need to be sources.
std::vector<SearchSource> OpenRim(const TravelFromStarts& from_starts, const StopFn& stop,
                                  Search& beyond) {
  const CellRect& cells = beyond.cells();
  const auto width = static_cast<std::size_t>(cells.width());
  Padded<std::uint8_t> own(cells, 0, 0, stop);
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    const int begin = beyond.IndexOf({cells.min.x, y});
    std::uint8_t* const row = own.Row(y);
    for (int x = 0; x < cells.width(); ++x) row[x] = beyond.IsOpen(begin + x) ? 1 : 0;
  });
  if (Stops(stop)) return {};
  std::vector<SearchSource> rim;
  std::vector<std::uint8_t> beside(width);
  ByRows(cells.min.y, cells.end.y, cells.width(), stop, [&](int y) {
    std::fill(beside.begin(), beside.end(), 0);
    for (const int offset : own.NeighbourOffsets()) {
      const std::uint8_t* const neighbour = own.Row(y) + offset;
      for (std::size_t x = 0; x < width; ++x) beside[x] |= neighbour[x];
    }
    const int begin = beyond.IndexOf({cells.min.x, y});
    for (int x = 0; x < cells.width(); ++x) {
      if (beside[static_cast<std::size_t>(x)] == 0 || !from_starts.IsReached(begin + x)) continue;
      beyond.Open(begin + x);
      rim.push_back({{cells.min.x + x, y}, 0.0});
    }
  });
  return rim;
}

// The ways from the reached cells over inflated free cells and frontier cells to the anchors.
Search SearchBeyond(const Grid<CellState>& states, const std::vector<Frontier>& frontiers,
                    const std::vector<Cell>& anchors, const TravelFromStarts& from_starts,
                    const StopFn& stop) {
  Search beyond = BeyondSearch(states, frontiers, from_starts, stop);
  if (Stops(stop)) return beyond;
  std::vector<int> pending;
  for (const Cell anchor : anchors) {
    const int cell = beyond.IndexOf(anchor);
    if (!from_starts.IsReached(cell)) pending.push_back(cell);
  }
  if (pending.empty()) return beyond;
  beyond.Run(OpenRim(from_starts, stop, beyond), [&](std::span<const Search::Entry>) {
    while (!pending.empty() && beyond.IsSettled(pending.back())) pending.pop_back();
    return pending.empty() || Stops(stop);
  });
  return beyond;
}

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

CellRect CellsAroundFree(const Grid<CellState>& states) {
  return BoundsOf(states, CellState::kFree).Grown(1).Within(WholeRaster(states.geometry()));
}

void FindGoalCells(const Grid<CellState>& states, const Grid<std::uint8_t>& traversable,
                   const std::vector<Cell>& starts, std::vector<Frontier>& frontiers) {
  if (frontiers.empty()) return;
  FindGoalCells(states, SearchFromStarts(states, traversable, starts), frontiers);
}

void FindGoalCells(const Grid<CellState>& states, const TravelFromStarts& from_starts,
                   std::vector<Frontier>& frontiers, const StopFn& stop) {
  if (frontiers.empty()) return;
  std::vector<Cell> anchors;
  for (const Frontier& frontier : frontiers) {
    if (Stops(stop)) return;
    anchors.push_back(Anchor(frontier, states.geometry()));
  }
  const Search beyond = SearchBeyond(states, frontiers, anchors, from_starts, stop);
  if (Stops(stop)) return;
  for (std::size_t i = 0; i < frontiers.size(); ++i) {
    const int anchor = beyond.IndexOf(anchors[i]);
    Frontier& frontier = frontiers[i];
    frontier.reachable = from_starts.IsReached(anchor) || beyond.IsReached(anchor);
    if (!frontier.reachable) continue;
    frontier.goal_cell =
        from_starts.IsReached(anchor) ? anchors[i] : beyond.WayTo(anchors[i]).front();
    frontier.travel_m = from_starts.Travel(frontier.goal_cell);
  }
}

}  // namespace plumescout
