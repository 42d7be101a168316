// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/linalg/sparse_cholesky.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "lab/linalg/selected_inverse.h"
#include "lab/linalg/supernodal_factor.h"
#include "lab/linalg/supernodal_pattern.h"
#include "lab/linalg/triangular_solve.h"

namespace plumescout::lab {

struct SparseCholesky::State {
  // What was analysed, to know it again.
  std::vector<int> column_start;
  std::vector<int> row;
  SupernodalPattern pattern;

  bool factorized = false;
  FactorValues factor;

  bool Knows(const SymmetricMatrix& matrix) const {
    return column_start == matrix.column_start && row == matrix.row;
  }

  absl::Status Analyze(const SymmetricMatrix& matrix) {
    column_start.clear();
    PLUMESCOUT_ASSIGN_OR_RETURN(pattern, AnalyzePattern(matrix));
    column_start = matrix.column_start;
    row = matrix.row;
    return absl::OkStatus();
  }

  absl::Status CheckSize(std::size_t size) const {
    if (!factorized) return absl::FailedPreconditionError("sparse Cholesky: no factor");
    if (size != static_cast<std::size_t>(pattern.n)) {
      return absl::InvalidArgumentError(
          absl::StrCat("sparse Cholesky: ", size, " values for n = ", pattern.n));
    }
    return absl::OkStatus();
  }
};

SparseCholesky::SparseCholesky() : state_(std::make_unique<State>()) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&& other) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&& other) noexcept = default;

absl::Status SparseCholesky::Factorize(const SymmetricMatrix& matrix) {
  state_->factorized = false;
  state_->factor = {};  // before the next one is made: memory for one factor, not two
  PLUMESCOUT_RETURN_IF_ERROR(Validate(matrix));
  if (matrix.n == 0) {
    *state_ = State();
  } else {
    if (!state_->Knows(matrix)) PLUMESCOUT_RETURN_IF_ERROR(state_->Analyze(matrix));
    PLUMESCOUT_ASSIGN_OR_RETURN(state_->factor, FactorizeSupernodes(state_->pattern, matrix.value));
  }
  state_->factorized = true;
  return absl::OkStatus();
}

bool SparseCholesky::factorized() const { return state_->factorized; }
int SparseCholesky::n() const { return state_->factorized ? state_->pattern.n : 0; }

absl::Status SparseCholesky::Solve(std::span<const double> b, std::span<double> x) const {
  PLUMESCOUT_RETURN_IF_ERROR(state_->CheckSize(b.size()));
  PLUMESCOUT_RETURN_IF_ERROR(state_->CheckSize(x.size()));
  SolveSupernodes(state_->pattern, state_->factor, b, x);
  return absl::OkStatus();
}

absl::Status SparseCholesky::InverseDiagonal(std::span<double> diagonal) const {
  PLUMESCOUT_RETURN_IF_ERROR(state_->CheckSize(diagonal.size()));
  InverseDiagonalSupernodes(state_->pattern, state_->factor, diagonal);
  return absl::OkStatus();
}

}  // namespace plumescout::lab
