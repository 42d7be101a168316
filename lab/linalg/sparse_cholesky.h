// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "absl/status/status.h"
#include "core/linalg/symmetric_matrix.h"

namespace plumescout::lab {

// Direct solver for A x = b with A sparse, symmetric and positive definite, and for the diagonal of
// A's inverse.
//
//   SparseCholesky cholesky;
//   RETURN_IF_ERROR(cholesky.Factorize(matrix));   // again for new values: keeps the ordering
//   RETURN_IF_ERROR(cholesky.Solve(b, x));
//   RETURN_IF_ERROR(cholesky.InverseDiagonal(diagonal));
//
// The same input gives the same bytes on every x86-64 machine; no threads. Solve and
// InverseDiagonal are const and may run at the same time on one factor.
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&& other) noexcept;
  SparseCholesky& operator=(SparseCholesky&& other) noexcept;

  // Orders the unknowns if the pattern of `matrix` differs from the last one, and factorises.
  // After an error there is no factor. Errors:
  //   kInvalidArgument     malformed matrix or a value that is not finite
  //   kFailedPrecondition  not positive definite
  //   kResourceExhausted   out of memory, or more than 2^31 - 1 indices
  //   kInternal            the ordering failed otherwise
  // Cost on a planar mesh: O(n^1.5) time, O(n log n) memory.
  absl::Status Factorize(const SymmetricMatrix& matrix);

  bool factorized() const;
  int n() const;  // of the factor; 0 without one

  // x = A^-1 b; b and x may be the same memory. Cost: two passes over the factor.
  // Errors: kFailedPrecondition without a factor, kInvalidArgument if b or x has not n values.
  absl::Status Solve(std::span<const double> b, std::span<double> x) const;

  // diagonal[i] = (A^-1)_ii, exact up to rounding: selected inversion. Cost: about twice that of
  // Factorize. Errors: as Solve.
  absl::Status InverseDiagonal(std::span<double> diagonal) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace plumescout::lab
