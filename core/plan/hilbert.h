// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>

#include "core/types/cell.h"

namespace plumescout {

// Square of `size` cells, a power of two. The curve enters it at `corner`, runs `along` first and
// leaves it at the far end of `across`; both are unit steps.
struct HilbertSquare {
  Cell corner;
  Cell along;
  Cell across;
  int size = 1;
};

// Visits the cells of the square that lie in [0, width) x [0, height). Squares outside are passed
// over whole.
template <typename Visit>
void WalkHilbertSquare(const HilbertSquare& square, int width, int height, Visit&& visit) {
  const auto [corner, along, across, size] = square;
  const int reach = size - 1;
  const Cell far{corner.x + reach * (along.x + across.x), corner.y + reach * (along.y + across.y)};
  if (std::min(corner.x, far.x) >= width || std::min(corner.y, far.y) >= height) return;
  if (size == 1) {
    visit(corner);
    return;
  }
  const int half = size / 2;
  const Cell a{along.x * half, along.y * half};
  const Cell c{across.x * half, across.y * half};
  const auto walk = [&](Cell at, Cell next_along, Cell next_across) {
    WalkHilbertSquare({at, next_along, next_across, half}, width, height, visit);
  };
  walk(corner, across, along);
  walk({corner.x + a.x, corner.y + a.y}, along, across);
  walk({corner.x + a.x + c.x, corner.y + a.y + c.y}, along, across);
  const Cell last{corner.x + a.x - along.x + 2 * c.x - across.x,
                  corner.y + a.y - along.y + 2 * c.y - across.y};
  walk(last, {-across.x, -across.y}, {-along.x, -along.y});
}

// Visits every cell of a width x height raster once, in the order of a Hilbert curve on the
// smallest square of a power of two around it. Cost: O(width * height).
template <typename Visit>
void ForEachCellAlongHilbert(int width, int height, Visit&& visit) {
  const auto extent = static_cast<unsigned>(std::max({width, height, 1}));
  const int size = static_cast<int>(std::bit_ceil(extent));
  WalkHilbertSquare({{0, 0}, {1, 0}, {0, 1}, size}, width, height, visit);
}

}  // namespace plumescout
