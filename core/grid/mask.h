// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/grid/padded.h"
#include "core/types/cell_rect.h"
#include "core/types/grid.h"

namespace plumescout {

// 1 where `predicate(value)` holds, else 0.
template <typename T, typename Predicate>
Grid<std::uint8_t> MaskWhere(const Grid<T>& grid, Predicate&& predicate) {
  Grid<std::uint8_t> mask(grid.geometry());
  std::transform(
      grid.values().begin(), grid.values().end(), mask.values().begin(),
      [&](const T& value) { return static_cast<std::uint8_t>(predicate(value) ? 1 : 0); });
  return mask;
}

// The first of [begin, end) that is `value`; `end` if none is.
template <typename T>
const T* FirstOf(const T* begin, const T* end, T value) {
  if (begin == end) return end;    // of no grid at all: null, which memchr may not be asked about
  if constexpr (sizeof(T) == 1) {  // much quicker than std::find
    const auto* const first = static_cast<const T*>(
        std::memchr(begin, static_cast<int>(value), static_cast<std::size_t>(end - begin)));
    return first == nullptr ? end : first;
  } else {
    return std::find(begin, end, value);
  }
}

// The least rectangle of cells that hold `value`; empty without any. Cost: O(cells off it).
template <typename T>
CellRect BoundsOf(const Grid<T>& grid, T value) {
  const int width = grid.width();
  const auto has_row = [&](int y) {
    const T* const row = GridRow(grid, y);
    return FirstOf(row, row + width, value) != row + width;
  };
  CellRect bounds({width, 0}, {0, grid.height()});
  while (bounds.min.y < bounds.end.y && !has_row(bounds.min.y)) ++bounds.min.y;
  while (bounds.end.y > bounds.min.y && !has_row(bounds.end.y - 1)) --bounds.end.y;
  for (int y = bounds.min.y; y < bounds.end.y; ++y) {
    const T* const row = GridRow(grid, y);
    bounds.min.x = static_cast<int>(FirstOf(row, row + bounds.min.x, value) - row);
    if (FirstOf(row + bounds.end.x, row + width, value) == row + width) continue;
    bounds.end.x = width;
    while (row[bounds.end.x - 1] != value) --bounds.end.x;
  }
  return bounds.empty() ? CellRect() : bounds;
}

// 1 where `grid` holds `value`, else 0.
template <typename T>
Grid<std::uint8_t> MaskOf(const Grid<T>& grid, T value) {
  return MaskWhere(grid, [value](const T& other) { return other == value; });
}

}  // namespace plumescout
