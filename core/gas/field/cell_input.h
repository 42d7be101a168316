// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

namespace plumescout {

// What the field is told of one cell: all of it, not a difference.
struct CellInput {
  bool active = false;              // has a variable: known to be free
  double precision = 0.0;           // sum of lambda_k of its readings, ppm^-2
  double weighted_deviation = 0.0;  // sum of lambda_k (z_k - m_0), ppm^-1
  // Whether a prior factor joins it to its neighbour, once both are active: on a lattice coarser
  // than the map there may be a wall between the two.
  bool linked_east = true;
  bool linked_north = true;

  friend bool operator==(const CellInput&, const CellInput&) = default;
};

struct CellChange {
  std::size_t cell = 0;  // index y * width + x
  CellInput input;
};

// Beyond any sensor, and far from where products of two overflow.
inline constexpr double kMaxCellPrecision = 1e100;

// Whether the numbers are such as readings can give; a field of others may not exist.
inline bool IsPossible(const CellInput& input) {
  return input.precision >= 0.0 && input.precision <= kMaxCellPrecision &&
         std::abs(input.weighted_deviation) <= kMaxCellPrecision;
}

}  // namespace plumescout
