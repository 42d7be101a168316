// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>

namespace plumescout {

// Cell of an occupancy grid: column x counted east, row y counted north, from the lower-left
// corner of a GridGeometry. Not a position in metres and not a row of a linear system.
struct Cell {
  int x = 0;
  int y = 0;

  friend auto operator<=>(const Cell&, const Cell&) = default;
};

}  // namespace plumescout
