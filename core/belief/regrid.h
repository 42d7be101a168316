// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "core/types/grid.h"

namespace plumescout {

// `grid` on another geometry of the same lattice: cells keep their place in the world, new ones
// get `fill`. REQUIRES: equal resolutions and origins a whole number of cells apart.
template <typename T>
Grid<T> Regridded(const Grid<T>& grid, const GridGeometry& geometry, T fill) {
  if (grid.geometry() == geometry) return grid;
  Grid<T> result(geometry, fill);
  const GridGeometry& old = grid.geometry();
  const int shift_x =
      static_cast<int>(std::lround((old.origin_x_m - geometry.origin_x_m) / geometry.resolution_m));
  const int shift_y =
      static_cast<int>(std::lround((old.origin_y_m - geometry.origin_y_m) / geometry.resolution_m));
  for (int y = 0; y < old.height; ++y) {
    for (int x = 0; x < old.width; ++x) {
      const Cell cell{x + shift_x, y + shift_y};
      if (result.Contains(cell)) result[cell] = grid[Cell{x, y}];
    }
  }
  return result;
}

}  // namespace plumescout
