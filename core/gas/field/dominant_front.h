// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace plumescout {

// Eliminates the first `columns` unknowns of a diagonally dominant M-matrix, in place.
//
// `front` holds the strict lower triangle, column-major, of a matrix whose entries off the diagonal
// are <= 0, without its diagonal: that of column j is minus the sum of the entries below it, of the
// rows before `dominant_rows`. The last of these rows, the ground, holds minus the excess of each
// diagonal over its row sum. So pivots are sums of terms of one sign and lose no digits, whatever
// the condition (Grassmann, Taksar and Heyman 1985). Rows from `dominant_rows` on are right-hand
// sides, of any sign.
//
// Leaves the Cholesky factor L in the first columns, diagonal included, and the Schur complement in
// the same form in columns [columns, unknowns).
struct DominantFront {
  double* values = nullptr;
  std::size_t stride = 0;  // >= PaddedRows(rows)
  std::size_t rows = 0;
  std::size_t dominant_rows = 0;
  std::size_t unknowns = 0;
  std::size_t columns = 0;
};
void EliminateDominant(const DominantFront& front);

}  // namespace plumescout
