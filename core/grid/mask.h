// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

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

// 1 where `grid` holds `value`, else 0.
template <typename T>
Grid<std::uint8_t> MaskOf(const Grid<T>& grid, T value) {
  return MaskWhere(grid, [value](const T& other) { return other == value; });
}

}  // namespace plumescout
