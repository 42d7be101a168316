// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grid/padded.h"
#include "core/plan/paths/path_planner.h"
#include "core/types/cell_rect.h"

namespace plumescout {

// Cheapest ways from one cell over the 8-connected grid, without cutting corners, under an edge
// cost: Dijkstra with a ring of buckets. A step may be cheaper than a bucket is wide, so a bucket
// is visited until it stays empty; a cell that got better meanwhile is visited again.
class CostSearch {
 public:
  // No way leaves `cells`. Of no use once `stop`, which is asked all along, says so. Cost:
  // O(`cells`).
  CostSearch(const EdgeCost& cost, const CellRect& cells, const StopFn& stop);
  explicit CostSearch(const EdgeCost& cost)
      : CostSearch(cost, WholeRaster(cost.geometry()), StopFn()) {}

  // Settles all `goals`, or all of them that can be reached. False if `stop` said so first. To be
  // called once. REQUIRES: `start` and the goals are in the cells. Cost: O(cells cheaper to reach
  // than the dearest goal).
  bool Run(Cell start, const std::vector<Cell>& goals, const StopFn& stop);

  // The polyline from `start`, inside the cell that Run began with, along the centres of cells to
  // that of `goal`, without the vertices in the middle of straight runs unless these cost; empty if
  // not reached.
  std::vector<Point2> WayTo(Cell goal, Point2 start) const;

 private:
  struct Entry {
    int cell;
    double g;
  };

  // Buckets for the dearest step: few enough that most are not empty, many enough that few cells
  // are visited twice. Any number gives the same costs.
  static constexpr int kBucketsPerStep = 8;
  // A step leads at most kBucketsPerStep buckets on, one more with rounding.
  static constexpr std::size_t kBuckets = kBucketsPerStep + 2;

  std::int64_t LevelOf(double g) const { return static_cast<std::int64_t>(g * levels_per_cost_); }
  std::vector<Entry>& BucketOf(std::int64_t level) {
    return buckets_[static_cast<std::size_t>(level) % kBuckets];
  }
  bool Settled(const std::vector<Cell>& goals) const;
  void Reach(int cell, std::int8_t from, double g);
  void ReachNeighbours(const Entry& from);

  const EdgeCost& cost_;
  Padded<float> penalty_;
  Padded<double> g_;
  Padded<std::int8_t> from_;  // which of the offsets leads there from the cell before
  std::array<int, 8> offsets_;
  double levels_per_cost_;
  std::array<std::vector<Entry>, kBuckets> buckets_;
  std::int64_t level_ = 0;
  std::int64_t waiting_ = 0;  // entries not visited yet
};

}  // namespace plumescout
