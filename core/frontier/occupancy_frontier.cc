// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/occupancy_frontier.h"

#include <array>
#include <cstddef>
#include <utility>

#include "core/frontier/cluster.h"
#include "core/frontier/goal_cells.h"
#include "core/grid/padded.h"

namespace plumescout {
namespace {

constexpr std::uint8_t kBlocked = 0;  // occupied, or outside
constexpr std::uint8_t kUnknown = 1;
constexpr std::uint8_t kWaiting = 2;  // a frontier cell in no cluster yet
constexpr std::uint8_t kTaken = 3;    // a frontier cell in a cluster
constexpr std::uint8_t kFree = 4;     // this and larger: free
constexpr std::uint8_t kReached = 5;

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
    for (const Cell start : free_starts) Visit(marks_.IndexOf(start));
    std::size_t since_stop = kCellsPerStop;
    std::vector<int> wave;
    while (!next_.empty()) {
      wave.clear();
      std::swap(wave, next_);
      since_stop += wave.size();
      if (since_stop >= kCellsPerStop) {
        if (Stops(stop)) return;
        since_stop = 0;
      }
      for (const int cell : wave) VisitNeighbours(cell);
    }
  }

  Padded<std::uint8_t>& marks() { return marks_; }
  const std::vector<int>& frontier() const { return frontier_; }  // in the order met

 private:
  void Visit(int cell) {
    if (marks_[cell] == kFree) {
      marks_[cell] = kReached;
      next_.push_back(cell);
    } else if (marks_[cell] == kUnknown) {
      marks_[cell] = kWaiting;
      frontier_.push_back(cell);
    }
  }

  void VisitNeighbours(int cell) {
    std::array<bool, 4> open{};
    for (std::size_t k = 0; k < 4; ++k) {
      const int neighbour = cell + offsets_[k];
      open[k] = marks_[neighbour] >= kFree;
      Visit(neighbour);
    }
    for (std::size_t k = 0; k < 4; ++k) {  // diagonal 4 + k lies between straights k and k + 1
      const int neighbour = cell + offsets_[4 + k];
      const bool cuts_corner = !open[k] || !open[(k + 1) % 4];
      if (marks_[neighbour] != kFree || !cuts_corner) Visit(neighbour);
    }
  }

  Padded<std::uint8_t> marks_;
  std::array<int, 8> offsets_;
  std::vector<int> next_;  // wave: what was reached and has to spread
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
