// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/goal_cells.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/grid/escape.h"
#include "core/grid/grid_search.h"
#include "core/grid/mask.h"
#include "core/grid/neighbours.h"
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

// The ways from the reached cells to these anchors, however long.
Search SearchBeyond(std::vector<std::size_t> pending, const std::vector<Cell>& anchors,
                    const Grid<CellState>& states, const std::vector<Frontier>& frontiers,
                    const TravelFromStarts& from_starts, const StopFn& stop) {
  Search beyond = BeyondSearch(states, frontiers, from_starts, stop);
  if (Stops(stop)) return beyond;
  beyond.Run(OpenRim(from_starts, stop, beyond), [&] {
    while (!pending.empty() && beyond.IsSettled(beyond.IndexOf(anchors[pending.back()]))) {
      pending.pop_back();
    }
    return pending.empty() || Stops(stop);
  });
  return beyond;
}

// Where the way to an anchor leaves the reached cells; none if there is no way.
std::optional<Cell> WhereLeft(const Search& beyond, Cell anchor) {
  if (!beyond.IsReached(beyond.IndexOf(anchor))) return std::nullopt;
  return beyond.WayTo(anchor).front();
}

// Searches the surroundings of single anchors, for most of them lie beside the reached cells or a
// few steps off. No more than a share of all cells is looked at, however many anchors there are.
class NearSearch {
 public:
  NearSearch(const Grid<CellState>& states, const std::vector<Frontier>& frontiers,
             const TravelFromStarts& from_starts, const StopFn& stop)
      : states_(states),
        from_starts_(from_starts),
        marks_(states.geometry(), 0, stop),
        budget_(from_starts.cells().size() / kShare) {
    if (Stops(stop)) return;
    for (const Frontier& frontier : frontiers) {
      for (const Cell cell : frontier.cells) marks_[cell] = kFrontier;
    }
  }

  // Where the way to an anchor that is not reached leaves the reached cells. None if that was not
  // found out.
  std::optional<Cell> GoalOf(Cell anchor) {
    if (const std::optional<Cell> beside = ReachedBeside(anchor)) return beside;
    around_.assign(1, anchor);
    rim_.clear();
    marks_[anchor] |= kAround;
    const bool is_whole = Surround();
    const std::optional<Cell> goal = is_whole && !rim_.empty() ? Nearest(anchor) : std::nullopt;
    for (const Cell cell : around_) marks_[cell] &= kFrontier;
    for (const Cell cell : rim_) marks_[cell] &= kFrontier;
    return goal;
  }

 private:
  static constexpr std::size_t kShare = 16;
  static constexpr std::uint8_t kFrontier = 1;
  static constexpr std::uint8_t kAround = 2;
  static constexpr std::uint8_t kRim = 4;

  bool IsReached(Cell cell) const {
    return from_starts_.cells().Contains(cell) &&
           from_starts_.IsReached(from_starts_.IndexOf(cell));
  }

  // In the order in which steps back are preferred.
  std::optional<Cell> ReachedBeside(Cell anchor) const {
    for (const Cell offset : kNeighbours8) {
      if (IsReached(Shifted(anchor, offset))) return Shifted(anchor, offset);
    }
    return std::nullopt;
  }

  // Finds the cells around the anchor, and the reached ones beside them, that shortest ways to it
  // may lead over: none of those has more straight steps than are as long as the fewest steps, all
  // diagonal. False if that takes too much.
  bool Surround() {
    std::size_t begin = 0;
    std::optional<int> most_steps;  // known once the rim is met
    for (int steps = 1; begin < around_.size() && steps <= most_steps.value_or(steps); ++steps) {
      const std::size_t end = around_.size();
      if (end - begin > budget_) return false;
      budget_ -= end - begin;
      for (; begin < end; ++begin) {
        for (const Cell offset : kNeighbours8) Meet(Shifted(around_[begin], offset));
      }
      if (!rim_.empty() && !most_steps) most_steps = static_cast<int>(kDiagonalStep_cells * steps);
    }
    return true;
  }

  void Meet(Cell cell) {
    if (!from_starts_.cells().Contains(cell)) return;
    std::uint8_t& mark = marks_[cell];
    if ((mark & (kAround | kRim)) != 0) return;
    if (from_starts_.IsReached(from_starts_.IndexOf(cell))) {
      mark |= kRim;
      rim_.push_back(cell);
    } else if (mark == kFrontier || states_[cell] == CellState::kFree) {
      mark |= kAround;
      around_.push_back(cell);
    }
  }

  std::optional<Cell> Nearest(Cell anchor) const {
    CellRect cells;
    for (const Cell cell : around_) cells.Include(cell);
    std::vector<SearchSource> sources;
    for (const Cell cell : rim_) {
      cells.Include(cell);
      sources.push_back({cell, 0.0});
    }
    Search beyond(states_.geometry(), cells, Connectivity::kEight,
                  [this](std::size_t index) { return (marks_[index] & (kAround | kRim)) != 0; });
    beyond.Run(std::move(sources), [&] { return beyond.IsSettled(beyond.IndexOf(anchor)); });
    return WhereLeft(beyond, anchor);
  }

  const Grid<CellState>& states_;
  const TravelFromStarts& from_starts_;
  Grid<std::uint8_t> marks_;  // kAround and kRim of one anchor at a time
  std::size_t budget_;        // cells
  std::vector<Cell> around_;
  std::vector<Cell> rim_;
};

// Of each anchor, by the ways over inflated free cells and frontier cells.
std::vector<std::optional<Cell>> GoalsOf(const std::vector<Cell>& anchors,
                                         const Grid<CellState>& states,
                                         const std::vector<Frontier>& frontiers,
                                         const TravelFromStarts& from_starts, const StopFn& stop) {
  std::vector<std::optional<Cell>> goals(anchors.size());
  std::vector<std::size_t> pending;
  NearSearch near(states, frontiers, from_starts, stop);
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    if (Stops(stop)) return goals;
    const bool is_reached = from_starts.IsReached(from_starts.IndexOf(anchors[i]));
    goals[i] = is_reached ? anchors[i] : near.GoalOf(anchors[i]);
    if (!goals[i]) pending.push_back(i);
  }
  if (pending.empty()) return goals;
  const Search beyond = SearchBeyond(pending, anchors, states, frontiers, from_starts, stop);
  if (Stops(stop)) return goals;
  for (const std::size_t i : pending) goals[i] = WhereLeft(beyond, anchors[i]);
  return goals;
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
  const std::vector<std::optional<Cell>> goals =
      GoalsOf(anchors, states, frontiers, from_starts, stop);
  if (Stops(stop)) return;
  for (std::size_t i = 0; i < frontiers.size(); ++i) {
    Frontier& frontier = frontiers[i];
    frontier.reachable = goals[i].has_value();
    if (!frontier.reachable) continue;
    frontier.goal_cell = *goals[i];
    frontier.travel_m = from_starts.Travel(frontier.goal_cell);
  }
}

}  // namespace plumescout
