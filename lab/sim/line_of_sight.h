// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"

namespace plumescout::lab {

// Which cells near a free cell see it, for all free cells, each worked out when first asked for:
// those to whose centre a straight line from its own centre crosses free cells only.
//
// Walking every line for every viewer would cost seconds. The lines are the same everywhere, so the
// shadow that an occupied cell casts depends on its offset only: they are walked once, and a viewer
// takes the shadows of the surfaces around it away from the raster.
// Cost: (2 radius + 1) words per surface cell within reach, once per viewer.
class LineOfSight {
 public:
  static constexpr int kMaxRadius_cells = 31;  // a row of 63 cells is one machine word

  // REQUIRES: 0 <= radius_cells <= kMaxRadius_cells; `occupancy` outlives this.
  LineOfSight(const Grid<CellState>& occupancy, int radius_cells);

  int radius_cells() const { return radius_cells_; }
  // What `viewer`, a free cell, sees: bit (dx + radius) of row (dy + radius) stands for the cell at
  // offset (dx, dy). Valid as long as this object.
  std::span<const std::uint64_t> From(Cell viewer);

 private:
  using Rows = std::vector<std::uint64_t>;

  std::size_t RowOf(int dy) const { return static_cast<std::size_t>(dy + radius_cells_); }
  std::uint64_t BitOf(int dx) const { return std::uint64_t{1} << (dx + radius_cells_); }
  Rows& ShadowOf(Cell offset);
  void CastShadows();
  void FindSurfaces();
  Rows Look(Cell viewer);

  const Grid<CellState>& occupancy_;
  int radius_cells_;
  std::vector<Rows> shadows_;      // by offset: the cells whose lines cross it, itself included
  Grid<std::uint8_t> is_surface_;  // occupied, beside a free cell: the first that a line can meet
  std::vector<Rows> seen_;         // by index of the viewer; empty: not yet asked
};

}  // namespace plumescout::lab
