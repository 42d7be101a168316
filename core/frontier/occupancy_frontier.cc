// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/occupancy_frontier.h"

#include <array>
#include <cstddef>

#include "core/frontier/cluster.h"
#include "core/frontier/goal_cells.h"
#include "core/grid/neighbours.h"
#include "core/grid/padded.h"

namespace plumescout {
namespace {

constexpr std::uint8_t kBlocked = 0;  // occupied, or outside
constexpr std::uint8_t kUnknown = 1;
constexpr std::uint8_t kWaiting = 2;  // a frontier cell in no cluster yet
constexpr std::uint8_t kTaken = 3;    // a frontier cell in a cluster
constexpr std::uint8_t kFree = 4;     // this and larger: free; one more: reached

std::uint8_t MarkOf(CellState state) {
  if (state == CellState::kFree) return kFree;
  return state == CellState::kUnknown ? kUnknown : kBlocked;
}

// The outer wavefront of WFD: spreads over free cells and marks the unknown ones it touches.
class OuterWavefront {
 public:
  explicit OuterWavefront(const Grid<CellState>& states)
      : marks_(PaddedFrom<std::uint8_t>(states, CellsAroundFree(states), kBlocked, MarkOf)),
        offsets_(marks_.NeighbourOffsets()) {}

  void Run(const std::vector<Cell>& free_starts, const StopFn& stop) {
    std::vector<int> reached;  // in the order in which they spread; behind `count` is room
    std::size_t count = 0;
    const auto tail = [&] {
      if (reached.size() < count + kNeighbours8.size()) {
        reached.resize(2 * (count + kNeighbours8.size()));
      }
      return reached.data() + count;
    };
    for (const Cell start : free_starts) {
      const int cell = marks_.IndexOf(start);
      count += Reach(cell, 1, marks_[cell], tail());
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (i % kCellsPerStop == 0 && Stops(stop)) return;
      int* const room = tail();
      count += ReachNeighbours(reached[i], room);
    }
  }

  Padded<std::uint8_t>& marks() { return marks_; }
  const std::vector<int>& frontier() const { return frontier_; }  // in the order met

 private:
  // Writes the cell to `slot`, and returns 1 if it is free and was not reached before, else 0:
  // without a branch, for which neighbours are new is past predicting.
  static std::size_t Reach(int cell, int allowed, std::uint8_t& mark, int* slot) {
    const int is_new = int{mark == kFree} & allowed;
    mark = static_cast<std::uint8_t>(mark + is_new);
    *slot = cell;
    return static_cast<std::size_t>(is_new);
  }

  // Writes those that are new to `slots`, and returns how many.
  std::size_t ReachNeighbours(int cell, int* slots) {
    const std::array<int, 8> offsets = offsets_;  // known not to change meanwhile
    std::uint8_t* const here = &marks_[cell];
    std::array<int, 4> open{};
    std::size_t count = 0;
    int unknown = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      std::uint8_t& mark = here[offsets[k]];
      open[k] = int{mark >= kFree};
      unknown |= int{mark == kUnknown};
      count += Reach(cell + offsets[k], 1, mark, slots + count);
    }
    for (std::size_t k = 0; k < 4; ++k) {  // diagonal 4 + k lies between straights k and k + 1
      std::uint8_t& mark = here[offsets[4 + k]];
      unknown |= int{mark == kUnknown};
      count += Reach(cell + offsets[4 + k], open[k] & open[(k + 1) % 4], mark, slots + count);
    }
    if (unknown != 0) MarkFrontier(cell);
    return count;
  }

  void MarkFrontier(int cell) {
    for (const int offset : offsets_) {
      if (marks_[cell + offset] != kUnknown) continue;
      marks_[cell + offset] = kWaiting;
      frontier_.push_back(cell + offset);
    }
  }

  Padded<std::uint8_t> marks_;
  std::array<int, 8> offsets_;
  std::vector<int> frontier_;
};

// Without their goal cells.
std::vector<Frontier> FindClusters(const Grid<CellState>& states, const std::vector<Cell>& starts,
                                   int min_cells, const StopFn& stop) {
  OuterWavefront wavefront(states);
  wavefront.Run(FreeStarts(states, starts), stop);
  const ClusterRule rule = {FrontierKind::kOccupancy, kWaiting, kTaken, min_cells};
  std::vector<Frontier> frontiers;
  for (const int cell : wavefront.frontier()) {
    if (wavefront.marks()[cell] != kWaiting) continue;
    if (Stops(stop)) break;
    frontiers.push_back(TakeCluster(states.geometry(), rule, cell, wavefront.marks()));
  }
  return frontiers;
}

}  // namespace

std::vector<Frontier> FindOccupancyFrontiers(const Grid<CellState>& states,
                                             const Grid<std::uint8_t>& traversable,
                                             const std::vector<Cell>& starts, int min_cells) {
  std::vector<Frontier> frontiers = FindClusters(states, starts, min_cells, {});
  FindGoalCells(states, traversable, starts, frontiers);
  return frontiers;
}

std::vector<Frontier> FindOccupancyFrontiers(const Grid<CellState>& states, Cell start,
                                             const TravelFromStarts& from_start, int min_cells,
                                             const StopFn& stop) {
  std::vector<Frontier> frontiers = FindClusters(states, {start}, min_cells, stop);
  if (!Stops(stop)) FindGoalCells(states, from_start, frontiers, stop);
  return frontiers;
}

}  // namespace plumescout
