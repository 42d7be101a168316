// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace plumescout {

struct LatticeCell {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

// Parallel lines that cover a lattice, numbered across. They are one cell thick, and no step
// between 4-neighbours leaps over one: each separates the cells on its two sides.
class LatticeLines {
 public:
  // Cells (x, y) with the same x + slope y, rounded, or y - slope x: for one slope the two are at
  // right angles. REQUIRES: -1 <= slope <= 1; cells are asked for in [0, width) x [0, height).
  enum class Across { kX, kY };
  LatticeLines(Across across, double slope, std::size_t width, std::size_t height);

  Across across() const { return across_; }
  // Never negative.
  std::int32_t line(LatticeCell cell) const {
    return across_ == Across::kX ? cell.x + shift_[static_cast<std::size_t>(cell.y)]
                                 : cell.y + shift_[static_cast<std::size_t>(cell.x)];
  }
  // One more than the largest.
  std::size_t count() const { return count_; }

 private:
  Across across_;
  std::vector<std::int32_t> shift_;
  std::size_t count_;
};

// The slope of most walls, cells without `active` (by index y * width + x) being walls: that for
// which the edges of walls crowd into the fewest lines. 0 if none stands out from the axes. Cost:
// O(edges * (width + height)).
double WallSlope(std::size_t width, std::size_t height, std::span<const std::uint8_t> active);

}  // namespace plumescout
