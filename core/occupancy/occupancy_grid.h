// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/status.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

// Log-odds occupancy grid that grows by whole tiles. Cell edges lie on whole multiples of the
// resolution from (0,0) of frame map, and growth moves the origin by whole tiles, so a cell keeps
// its place in the world for the whole mission.
//
// Invariants: 1. width and height are multiples of kTileCells. 2. |log-odds| <= clamp. 3. neither
// extent nor cell count ever exceeds the options. Thread-compatible.
class OccupancyGrid {
 public:
  static constexpr int kTileCells = 64;

  // REQUIRES: Validate(options).ok(). The grid starts empty (0 x 0).
  explicit OccupancyGrid(const OccupancyOptions& options);

  const OccupancyOptions& options() const { return options_; }
  const GridGeometry& geometry() const { return log_odds_.geometry(); }

  // Grows until [min, max] is inside. kResourceExhausted, with nothing changed, beyond the limits.
  absl::Status GrowToContain(Point2 min, Point2 max);

  // Adds to the log-odds of a cell, clamped. REQUIRES: geometry().Contains(cell).
  void Add(Cell cell, double log_odds);

  // Probability of occupation, 0.5 where nothing is known or outside.
  double Probability(Cell cell) const;
  CellState State(Cell cell) const;
  // The states of all cells. Cost: O(cells).
  Grid<CellState> States() const;

 private:
  OccupancyOptions options_;
  float free_log_odds_;      // at or below: free
  float occupied_log_odds_;  // at or above: occupied
  Grid<float> log_odds_;
};

}  // namespace plumescout
