// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/window_sums.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace plumescout {

Grid<float> WindowSums(const Grid<float>& values, int reach_cells) {
  const int width = values.width();
  const int height = values.height();
  // (x, y) holds the sum over all cells west of x and south of y (Crow 1984).
  Grid<double> table(GridGeometry{0.0, 0.0, 1.0, width + 1, height + 1}, 0.0);
  for (int y = 0; y < height; ++y) {
    double row = 0.0;
    for (int x = 0; x < width; ++x) {
      row += static_cast<double>(values[Cell{x, y}]);
      table[Cell{x + 1, y + 1}] = table[Cell{x + 1, y}] + row;
    }
  }
  Grid<float> sums(values.geometry());
  for (int y = 0; y < height; ++y) {
    const int south = std::max(0, y - reach_cells);
    const int north = std::min(height, y + reach_cells + 1);
    for (int x = 0; x < width; ++x) {
      const int west = std::max(0, x - reach_cells);
      const int east = std::min(width, x + reach_cells + 1);
      sums[Cell{x, y}] = static_cast<float>(table[Cell{east, north}] - table[Cell{west, north}] -
                                            table[Cell{east, south}] + table[Cell{west, south}]);
    }
  }
  return sums;
}

}  // namespace plumescout
