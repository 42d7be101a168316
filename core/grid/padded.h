// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/grid/neighbours.h"
#include "core/types/grid.h"

namespace plumescout {

// A raster with a border one cell wide. Inside searches a cell is an index into it, its neighbours
// are fixed offsets, and the border stands for "outside" without a bounds check.
template <typename T>
class Padded {
 public:
  Padded(const GridGeometry& geometry, T border, T fill)
      : stride_(geometry.width + 2),
        values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(geometry.height + 2),
                border) {
    for (int y = 0; y < geometry.height; ++y) std::fill_n(Row(y), geometry.width, fill);
  }

  int stride() const { return stride_; }
  int IndexOf(Cell cell) const { return (cell.y + 1) * stride_ + cell.x + 1; }
  Cell CellAt(int index) const { return {index % stride_ - 1, index / stride_ - 1}; }

  T& operator[](int index) { return values_[static_cast<std::size_t>(index)]; }
  const T& operator[](int index) const { return values_[static_cast<std::size_t>(index)]; }

  // First cell of row y of the raster proper.
  T* Row(int y) { return values_.data() + IndexOf({0, y}); }
  const T* Row(int y) const { return values_.data() + IndexOf({0, y}); }

  // Index offsets in the order of kNeighbours8.
  std::array<int, 8> NeighbourOffsets() const {
    std::array<int, 8> offsets{};
    std::transform(kNeighbours8.begin(), kNeighbours8.end(), offsets.begin(),
                   [this](Cell offset) { return offset.y * stride_ + offset.x; });
    return offsets;
  }

 private:
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

// The raster, each value mapped by `convert`, inside a border.
template <typename T, typename U, typename Convert>
Padded<T> PaddedFrom(const Grid<U>& grid, T border, Convert&& convert) {
  Padded<T> padded(grid.geometry(), border, border);
  for (int y = 0; y < grid.height(); ++y) {
    const U* row = GridRow(grid, y);
    std::transform(row, row + grid.width(), padded.Row(y), convert);
  }
  return padded;
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
