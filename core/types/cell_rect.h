// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>

#include "core/types/cell.h"
#include "core/types/grid_geometry.h"

namespace plumescout {

// Cells from `min` up to but without `end`, on both axes. Which cells is said by their type: those
// of a raster, of an anchor, of the gas lattice.
template <typename AnyCell>
struct CellRectOf {
  AnyCell min;
  AnyCell end;

  // Not an aggregate: {min, width, height} would pass for corners.
  constexpr CellRectOf() = default;
  constexpr CellRectOf(AnyCell min_cell, AnyCell end_cell) : min(min_cell), end(end_cell) {}
  static CellRectOf Sized(AnyCell min, int width, int height) {
    return {min, {min.x + width, min.y + height}};
  }

  int width() const { return end.x - min.x; }
  int height() const { return end.y - min.y; }
  // REQUIRES: the end is not before the beginning.
  std::size_t size() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  bool empty() const { return min.x >= end.x || min.y >= end.y; }

  bool Contains(AnyCell cell) const {
    return cell.x >= min.x && cell.y >= min.y && cell.x < end.x && cell.y < end.y;
  }
  bool Covers(const CellRectOf& other) const {
    return min.x <= other.min.x && min.y <= other.min.y && end.x >= other.end.x &&
           end.y >= other.end.y;
  }
  bool Overlaps(const CellRectOf& other) const {
    return min.x < other.end.x && other.min.x < end.x && min.y < other.end.y && other.min.y < end.y;
  }

  // With so many cells more on each side.
  CellRectOf Grown(int by) const { return {{min.x - by, min.y - by}, {end.x + by, end.y + by}}; }
  // The cells of both; empty if there are none.
  CellRectOf Within(const CellRectOf& other) const {
    return {{std::max(min.x, other.min.x), std::max(min.y, other.min.y)},
            {std::min(end.x, other.end.x), std::min(end.y, other.end.y)}};
  }
  // The smallest that holds both. REQUIRES: neither is empty.
  CellRectOf With(const CellRectOf& other) const {
    return {{std::min(min.x, other.min.x), std::min(min.y, other.min.y)},
            {std::max(end.x, other.end.x), std::max(end.y, other.end.y)}};
  }
  void Include(AnyCell cell) {
    const CellRectOf one = Sized(cell, 1, 1);
    *this = empty() ? one : With(one);
  }

  friend auto operator<=>(const CellRectOf&, const CellRectOf&) = default;
};

using CellRect = CellRectOf<Cell>;

inline CellRect WholeRaster(const GridGeometry& geometry) {
  return {{0, 0}, {geometry.width, geometry.height}};
}

}  // namespace plumescout
