// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/linalg/symmetric_matrix.h"

namespace plumescout {

struct CholmodSolution {
  std::vector<double> x;                 // A x = b
  std::vector<double> inverse_diagonal;  // (A^-1)_ii
};

// Solves A x = b by CHOLMOD: approximate minimum degree, its column-by-column (simplicial) Cholesky
// factorisation and its triangular solves; these use neither BLAS nor threads. The diagonal of the
// inverse is that of Takahashi's recursion on CHOLMOD's factor (column_inverse.h). Shares no code
// with the dense kernels. Errors: kInvalidArgument as Validate, or if b has not n values;
// kFailedPrecondition if A is not positive definite; kResourceExhausted, kInternal.
// Cost: 1.3 to 8 times that of dense blocks, as in lab/linalg, rooms to open ground, for 12 bytes
// of memory for each entry of the factor.
absl::StatusOr<CholmodSolution> SolveByCholmod(const SymmetricMatrix& matrix,
                                               std::span<const double> b);

}  // namespace plumescout
