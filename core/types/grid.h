// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <utility>
#include <vector>

#include "core/types/grid_geometry.h"
#include "core/types/stop.h"

namespace plumescout {

// Raster of T over a GridGeometry. T must not be bool: use std::uint8_t.
template <typename T>
class Grid {
 public:
  Grid() = default;
  explicit Grid(const GridGeometry& geometry, T fill = T{})
      : geometry_(geometry), values_(geometry.size(), fill) {}

  // The same; without any cells if `stop`, which is asked all along, says so. New memory takes
  // long.
  Grid(const GridGeometry& geometry, T fill, const StopFn& stop) {
    values_.reserve(geometry.size());
    const auto add = [&](std::size_t, std::size_t end) { values_.resize(end, fill); };
    if (InPieces(geometry.size(), stop, add)) {
      geometry_ = geometry;
    } else {
      values_.clear();
    }
  }

  const GridGeometry& geometry() const { return geometry_; }
  int width() const { return geometry_.width; }
  int height() const { return geometry_.height; }
  std::size_t size() const { return values_.size(); }
  bool Contains(Cell cell) const { return geometry_.Contains(cell); }

  T& operator[](Cell cell) {
    assert(Contains(cell));
    return values_[geometry_.Index(cell)];
  }
  const T& operator[](Cell cell) const {
    assert(Contains(cell));
    return values_[geometry_.Index(cell)];
  }
  T& operator[](std::size_t index) { return values_[index]; }
  const T& operator[](std::size_t index) const { return values_[index]; }

  // The value at `cell`, or `outside` beyond the raster.
  T At(Cell cell, T outside) const { return Contains(cell) ? (*this)[cell] : outside; }

  std::vector<T>& values() { return values_; }
  const std::vector<T>& values() const { return values_; }

  friend bool operator==(const Grid&, const Grid&) = default;

 private:
  GridGeometry geometry_;
  std::vector<T> values_;
};

}  // namespace plumescout
