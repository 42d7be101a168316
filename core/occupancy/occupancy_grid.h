// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "absl/status/status.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/map_tiles.h"
#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

// Log-odds occupancy grid that grows by whole tiles. Cell edges lie on whole multiples of the
// resolution from (0,0) of frame map, and growth moves the origin by whole tiles, so a cell keeps
// its place in the world for the whole mission.
//
// A cell is free from where its probability falls to tau_free until it rises to tau_occ, and the
// other way round; unknown is what has never come to either. The paper's rule, unknown in between
// ([XIT] section III), makes cells at the face of a wall change with every few scans
// (docs/decisions).
//
// Invariants: 1. width and height are multiples of kTileCells. 2. |log-odds| <= clamp. 3. neither
// extent nor cell count ever exceeds the options. Thread-compatible.
class OccupancyGrid {
 public:
  static constexpr int kTileCells = kMapTileCells;

  // REQUIRES: Validate(options).ok(). The grid starts empty (0 x 0).
  explicit OccupancyGrid(const OccupancyOptions& options);

  const OccupancyOptions& options() const { return options_; }
  const GridGeometry& geometry() const { return log_odds_.geometry(); }

  // Grows until [min, max] and one more cell on every side are inside, so that each cell seen has
  // all its neighbours: what lies beyond it is an unknown cell, not the end of the map.
  // Errors, with nothing changed: kResourceExhausted beyond the limits, BUDGET_REACHED beyond that
  // of LimitCells; kInvalidArgument if the rectangle is not finite or min > max. Cost: O(cells) if
  // it grows, else O(1).
  absl::Status GrowToContain(Point2 min, Point2 max);
  // From now on it grows no further than to so many cells, for want of memory.
  void LimitCells(std::int64_t cells) { cell_limit_ = cells; }

  // Takes over what a map of the building says: its free and occupied cells are as certain as scans
  // can make them, and scans change them like any others.
  // Errors, with nothing changed: those of ValidatePriorMap; of GrowToContain if the grid has grown
  // elsewhere before. Cost: O(cells).
  absl::Status Learn(const Grid<CellState>& map);

  // Adds to the log-odds of a cell, clamped. REQUIRES: geometry().Contains(cell).
  void Add(Cell cell, double log_odds) { Add(geometry().Index(cell), log_odds); }
  // The same by index into the raster.
  void Add(std::size_t index, double log_odds) {
    const float clamp = static_cast<float>(options_.clamp_log_odds);
    float& value = log_odds_[index];
    value = std::clamp(value + static_cast<float>(log_odds), -clamp, clamp);
    if (value <= free_log_odds_) {
      states_[index] = CellState::kFree;
    } else if (value >= occupied_log_odds_) {
      states_[index] = CellState::kOccupied;
    }
  }

  // Probability of occupation, 0.5 where nothing is known or outside.
  double Probability(Cell cell) const;
  // kUnknown outside.
  CellState State(Cell cell) const { return states_.At(cell, CellState::kUnknown); }
  const Grid<CellState>& States() const { return states_; }

  // See core/types/byte_archive.h; what LimitCells was told is no state.
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  OccupancyOptions options_;
  std::int64_t cell_limit_ = std::numeric_limits<std::int64_t>::max();
  float free_log_odds_;      // at or below: free
  float occupied_log_odds_;  // at or above: occupied
  Grid<float> log_odds_;
  Grid<CellState> states_;
};

}  // namespace plumescout
