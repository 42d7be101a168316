// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/grid/neighbours.h"
#include "core/types/cell_rect.h"
#include "core/types/grid.h"
#include "core/types/stop.h"

namespace plumescout {

// A raster, or a rectangle out of one, with a border one cell wide. Inside searches a cell is an
// index into it, its neighbours are fixed offsets, and the border stands for "outside" without a
// bounds check.
template <typename T>
class Padded {
 public:
  Padded(const GridGeometry& geometry, T border, T fill)
      : Padded(WholeRaster(geometry), border, fill) {}
  // Without any cells, and not to be looked into, if `stop`, which is asked all along, says so.
  Padded(const CellRect& cells, T border, T fill, const StopFn& stop = {})
      : min_(cells.min), stride_(cells.width() + 2) {
    const auto size = CellRect::Sized({}, stride_, cells.height() + 2).size();
    values_.reserve(size);
    const auto add = [&](std::size_t, std::size_t end) { values_.resize(end, border); };
    if (!InPieces(size, stop, add)) values_.clear();
    if (fill == border || empty()) return;
    for (int y = cells.min.y; y < cells.end.y; ++y) std::fill_n(Row(y), cells.width(), fill);
  }

  bool empty() const { return values_.empty(); }

  int stride() const { return stride_; }
  // Of a cell of the rectangle, or beside it.
  int IndexOf(Cell cell) const { return (cell.y - min_.y + 1) * stride_ + cell.x - min_.x + 1; }
  Cell CellAt(int index) const {
    return {min_.x + index % stride_ - 1, min_.y + index / stride_ - 1};
  }

  T& operator[](int index) { return values_[static_cast<std::size_t>(index)]; }
  const T& operator[](int index) const { return values_[static_cast<std::size_t>(index)]; }

  // First cell of row y of the rectangle.
  T* Row(int y) { return values_.data() + IndexOf({min_.x, y}); }
  const T* Row(int y) const { return values_.data() + IndexOf({min_.x, y}); }

  // Index offsets in the order of kNeighbours8.
  std::array<int, 8> NeighbourOffsets() const {
    std::array<int, 8> offsets{};
    std::transform(kNeighbours8.begin(), kNeighbours8.end(), offsets.begin(),
                   [this](Cell offset) { return offset.y * stride_ + offset.x; });
    return offsets;
  }

 private:
  Cell min_;
  int stride_;
  std::vector<T> values_;
};

// Row y of a raster, `width` cells from the west.
template <typename T>
T* GridRow(Grid<T>& grid, int y) {
  return grid.values().data() + static_cast<std::ptrdiff_t>(y) * grid.width();
}
template <typename T>
const T* GridRow(const Grid<T>& grid, int y) {
  return grid.values().data() + static_cast<std::ptrdiff_t>(y) * grid.width();
}

// These cells of the raster, each value mapped by `convert`, inside a border.
template <typename T, typename U, typename Convert>
Padded<T> PaddedFrom(const Grid<U>& grid, const CellRect& cells, T border, Convert&& convert) {
  Padded<T> padded(cells, border, border);
  for (int y = cells.min.y; y < cells.end.y; ++y) {
    const U* const row = GridRow(grid, y);
    std::transform(row + cells.min.x, row + cells.end.x, padded.Row(y), convert);
  }
  return padded;
}
template <typename T, typename U, typename Convert>
Padded<T> PaddedFrom(const Grid<U>& grid, T border, Convert&& convert) {
  return PaddedFrom<T>(grid, WholeRaster(grid.geometry()), border, convert);
}

// The raster proper of `padded`, each value mapped by `convert`.
template <typename T, typename U, typename Convert>
Grid<T> GridFrom(const Padded<U>& padded, const GridGeometry& geometry, Convert&& convert) {
  Grid<T> grid(geometry);
  for (int y = 0; y < geometry.height; ++y) {
    const U* row = padded.Row(y);
    std::transform(row, row + geometry.width, GridRow(grid, y), convert);
  }
  return grid;
}

}  // namespace plumescout
