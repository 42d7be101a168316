// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/cell_rect.h"
#include "core/types/grid.h"

namespace plumescout::lab {

// Sets the cells of a rectangle; those beyond the grid are left out.
template <typename T>
void Fill(const CellRect& rect, T value, Grid<T>& grid) {
  const CellRect inside = rect.Within(WholeRaster(grid.geometry()));
  for (int y = inside.min.y; y < inside.end.y; ++y) {
    for (int x = inside.min.x; x < inside.end.x; ++x) grid[Cell{x, y}] = value;
  }
}

}  // namespace plumescout::lab
