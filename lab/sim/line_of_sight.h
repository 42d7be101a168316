// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"

namespace plumescout::lab {

// Which cells near a free cell see it, for all free cells, each worked out when first asked for.
// A cell is seen if it is free and the cell before it on the straight line from the viewer is seen.
// Cost: (2 radius + 1)^2 steps and 8 (2 radius + 1) bytes per viewer, once.
class LineOfSight {
 public:
  static constexpr int kMaxRadius_cells = 31;  // a row of 63 cells is one machine word

  // REQUIRES: 0 <= radius_cells <= kMaxRadius_cells.
  LineOfSight(const Grid<CellState>& occupancy, int radius_cells);

  int radius_cells() const { return radius_cells_; }
  // What `viewer`, a free cell, sees: bit (dx + radius) of row (dy + radius) stands for the cell at
  // offset (dx, dy). Valid as long as this object.
  std::span<const std::uint64_t> From(Cell viewer);

 private:
  struct Ray {
    Cell offset;
    Cell before;  // offset of the cell before it on the line from the viewer
  };

  std::vector<std::uint64_t> Look(Cell viewer) const;

  const Grid<CellState>& occupancy_;
  int radius_cells_;
  std::vector<Ray> rays_;                         // nearest first, without the viewer itself
  std::vector<std::vector<std::uint64_t>> seen_;  // by index of the viewer; empty: not yet asked
};

}  // namespace plumescout::lab
