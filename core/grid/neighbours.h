// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "core/types/cell.h"

namespace plumescout {

// Offsets to the neighbours of a cell, counter-clockwise from east. In kNeighbours8 the straight
// ones come first, so that searches prefer them on ties.
inline constexpr std::array<Cell, 4> kNeighbours4 = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
inline constexpr std::array<Cell, 8> kNeighbours8 = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

// Lengths of steps between the centres of neighbours, in cells.
inline constexpr double kStraightStep_cells = 1.0;
inline constexpr double kDiagonalStep_cells = 1.41421356237309504880;

// Which steps a wavefront may take.
enum class Connectivity {
  kFour,              // straight steps
  kEightNoCornerCut,  // diagonal steps too, if both cells beside the diagonal are passable
  kEight,             // all neighbours
};

constexpr Cell Shifted(Cell cell, Cell offset) { return {cell.x + offset.x, cell.y + offset.y}; }

constexpr bool IsDiagonal(Cell offset) { return offset.x != 0 && offset.y != 0; }

constexpr double StepLength_cells(Cell offset) {
  return IsDiagonal(offset) ? kDiagonalStep_cells : kStraightStep_cells;
}

// The corner rule: whether a body may step from passable `cell` by `offset`, one of kNeighbours8.
// `passable(Cell) -> bool` answers for cells outside the raster too.
template <typename Passable>
bool StepAllowed(Cell cell, Cell offset, Passable&& passable) {
  if (!passable(Shifted(cell, offset))) return false;
  return !IsDiagonal(offset) ||
         (passable(Shifted(cell, {offset.x, 0})) && passable(Shifted(cell, {0, offset.y})));
}

// The neighbour over which the shortest way enters `cell`; none if the way starts there.
// `travel(Cell) -> Length` gives what a search found, infinite where it did not come.
template <typename Length, typename Travel>
std::optional<Cell> Predecessor(Cell cell, double resolution_m, Connectivity connectivity,
                                Travel&& travel) {
  constexpr Length kUnreached = std::numeric_limits<Length>::infinity();
  const auto reached = [&travel](Cell c) { return travel(c) < kUnreached; };
  std::optional<Cell> best;
  Length best_m = travel(cell);
  for (const Cell offset : kNeighbours8) {
    if (IsDiagonal(offset) && connectivity == Connectivity::kFour) continue;
    if (connectivity == Connectivity::kEightNoCornerCut && !StepAllowed(cell, offset, reached)) {
      continue;
    }
    const Cell from = Shifted(cell, offset);
    // The same sum as the search formed, so that it is met exactly; infinite where not reached.
    const Length via_m =
        travel(from) + static_cast<Length>(StepLength_cells(offset) * resolution_m);
    if (via_m < best_m || (via_m == best_m && !best)) {
      best = from;
      best_m = via_m;
    }
  }
  return best;
}

}  // namespace plumescout
