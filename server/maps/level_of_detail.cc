// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/level_of_detail.h"

#include <cmath>
#include <limits>

namespace plumescout::server {
namespace {

int DivideUp(int count, int level) { return (count + (1 << level) - 1) >> level; }

// Each square's cells brought together by `join`, beginning with `least`.
template <typename T, typename Join>
Grid<T> Joined(const Grid<T>& cells, int level, const CellRect& squares, T least, Join join) {
  Grid<T> joined(GridGeometry{0.0, 0.0, 1.0, squares.width(), squares.height()}, least);
  const CellRect rect = CellsOf(squares, level, cells.geometry());
  for (int y = 0; y < rect.height(); ++y) {
    const T* row = &cells[Cell{rect.min.x, rect.min.y + y}];
    T* out = &joined[Cell{0, y >> level}];
    for (int x = 0; x < rect.width(); ++x) out[x >> level] = join(out[x >> level], row[x]);
  }
  return joined;
}

int Badness(CellState state) {
  switch (state) {
    case CellState::kFree:
      return 0;
    case CellState::kUnknown:
      return 1;
    case CellState::kOccupied:
      break;
  }
  return 2;
}

}  // namespace

GridGeometry SquaresOf(const GridGeometry& cells, int level) {
  return {cells.origin_x_m, cells.origin_y_m, std::ldexp(cells.resolution_m, level),
          DivideUp(cells.width, level), DivideUp(cells.height, level)};
}

CellRect CellsOf(const CellRect& squares, int level, const GridGeometry& cells) {
  const CellRect whole{{squares.min.x << level, squares.min.y << level},
                       {squares.end.x << level, squares.end.y << level}};
  return whole.Within(WholeRaster(cells));
}

Grid<CellState> WorstStates(const Grid<CellState>& cells, int level, const CellRect& squares) {
  return Joined(cells, level, squares, CellState::kFree,
                [](CellState a, CellState b) { return Badness(b) > Badness(a) ? b : a; });
}

Grid<float> LargestValues(const Grid<float>& cells, int level, const CellRect& squares) {
  return Joined(cells, level, squares, std::numeric_limits<float>::quiet_NaN(),
                [](float a, float b) { return std::isnan(a) || b > a ? b : a; });
}

}  // namespace plumescout::server
