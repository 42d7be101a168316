// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

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

// The quarters of a square in the order of the curve.
constexpr std::array<HilbertSquare, 4> HilbertQuarters(const HilbertSquare& square) {
  const auto [corner, along, across, size] = square;
  const int half = size / 2;
  const Cell a{along.x * half, along.y * half};
  const Cell c{across.x * half, across.y * half};
  const Cell last{corner.x + a.x - along.x + 2 * c.x - across.x,
                  corner.y + a.y - along.y + 2 * c.y - across.y};
  return {{{corner, across, along, half},
           {{corner.x + a.x, corner.y + a.y}, along, across, half},
           {{corner.x + a.x + c.x, corner.y + a.y + c.y}, along, across, half},
           {last, {-across.x, -across.y}, {-along.x, -along.y}, half}}};
}

// Offsets (along, across) of the cells of a square of kHilbertTile, in the order of the curve.
inline constexpr int kHilbertTile = 8;
struct HilbertOrder {
  constexpr HilbertOrder() {
    std::size_t count = 0;
    Fill({{0, 0}, {1, 0}, {0, 1}, kHilbertTile}, count);
  }

  std::array<Cell, kHilbertTile * kHilbertTile> cells{};

 private:
  constexpr void Fill(const HilbertSquare& square, std::size_t& count) {
    if (square.size == 1) {
      cells[count++] = square.corner;
      return;
    }
    for (const HilbertSquare& quarter : HilbertQuarters(square)) Fill(quarter, count);
  }
};
inline constexpr HilbertOrder kHilbertOrder;

// Visits the cells of the square, of at least kHilbertTile, that lie in [0, width) x [0, height).
// Squares outside are passed over whole, and those that `pass(low, high)` says of, corners of a
// square.
template <typename Visit, typename Pass>
void WalkHilbertSquare(const HilbertSquare& square, int width, int height, Visit& visit,
                       Pass& pass) {
  const auto [corner, along, across, size] = square;
  const int reach = size - 1;
  const Cell far{corner.x + reach * (along.x + across.x), corner.y + reach * (along.y + across.y)};
  const Cell low{std::min(corner.x, far.x), std::min(corner.y, far.y)};
  if (low.x >= width || low.y >= height) return;
  if (pass(low, Cell{low.x + reach, low.y + reach})) return;
  if (size > kHilbertTile) {
    for (const HilbertSquare& quarter : HilbertQuarters(square)) {
      WalkHilbertSquare(quarter, width, height, visit, pass);
    }
    return;
  }
  const bool is_inside = low.x + reach < width && low.y + reach < height;
  for (const Cell at : kHilbertOrder.cells) {
    const Cell cell{corner.x + at.x * along.x + at.y * across.x,
                    corner.y + at.x * along.y + at.y * across.y};
    if (is_inside || (cell.x < width && cell.y < height)) visit(cell);
  }
}

// Visits every cell of a width x height raster once, in the order of a Hilbert curve on the
// smallest square of a power of two around it, of kHilbertTile at least, but for squares that are
// passed over. Cost: O(width * height).
template <typename Visit, typename Pass>
void ForEachCellAlongHilbert(int width, int height, Visit&& visit, Pass&& pass) {
  const auto extent = static_cast<unsigned>(std::max({width, height, kHilbertTile}));
  const int size = static_cast<int>(std::bit_ceil(extent));
  WalkHilbertSquare({{0, 0}, {1, 0}, {0, 1}, size}, width, height, visit, pass);
}
template <typename Visit>
void ForEachCellAlongHilbert(int width, int height, Visit&& visit) {
  ForEachCellAlongHilbert(width, height, visit, [](Cell, Cell) { return false; });
}

}  // namespace plumescout
