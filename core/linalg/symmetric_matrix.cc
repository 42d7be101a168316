// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/linalg/symmetric_matrix.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "absl/strings/str_cat.h"
#include "core/types/checker.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

std::size_t Unsigned(int index) { return static_cast<std::size_t>(index); }

absl::Status ValidateStarts(const SymmetricMatrix& matrix) {
  const std::vector<int>& start = matrix.column_start;
  if (matrix.n < 0 || start.size() != Unsigned(matrix.n) + 1 || start.front() != 0 ||
      Unsigned(start.back()) != matrix.row.size() || matrix.row.size() != matrix.value.size()) {
    return absl::InvalidArgumentError(
        absl::StrCat("symmetric matrix: n = ", matrix.n, " with ", start.size(), " column starts, ",
                     matrix.row.size(), " rows and ", matrix.value.size(), " values is malformed"));
  }
  if (!std::is_sorted(start.begin(), start.end())) {
    return absl::InvalidArgumentError("symmetric matrix: column starts must not descend");
  }
  return absl::OkStatus();
}

absl::Status ValidateColumn(const SymmetricMatrix& matrix, int column) {
  const int begin = matrix.column_start[Unsigned(column)];
  const int end = matrix.column_start[Unsigned(column) + 1];
  if (begin == end || matrix.row[Unsigned(begin)] != column) {
    return absl::InvalidArgumentError(
        absl::StrCat("symmetric matrix: column ", column, " must begin with its diagonal"));
  }
  for (int k = begin; k < end; ++k) {
    const int row = matrix.row[Unsigned(k)];
    const int least = k == begin ? column : matrix.row[Unsigned(k) - 1] + 1;
    if (row < least || row >= matrix.n) {
      return absl::InvalidArgumentError(absl::StrCat("symmetric matrix: row ", row, " of column ",
                                                     column, " must be in [", least, ", ", matrix.n,
                                                     ")"));
    }
    if (!std::isfinite(matrix.value[Unsigned(k)])) {
      return absl::InvalidArgumentError(
          absl::StrCat("symmetric matrix: entry (", row, ", ", column, ") is not finite"));
    }
  }
  return absl::OkStatus();
}

// Sorted by column, then row, with a zero on every diagonal.
std::vector<Triplet> SortedWithDiagonal(int n, std::span<const Triplet> triplets) {
  std::vector<Triplet> sorted(triplets.begin(), triplets.end());
  for (int i = 0; i < n; ++i) sorted.push_back({i, i, 0.0});
  std::stable_sort(sorted.begin(), sorted.end(), [](const Triplet& a, const Triplet& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  });
  return sorted;
}

}  // namespace

absl::StatusOr<SymmetricMatrix> SymmetricFromTriplets(int n, std::span<const Triplet> triplets) {
  PLUMESCOUT_RETURN_IF_ERROR(Checker().AtLeast("n", n, 0).status());
  for (const Triplet& t : triplets) {
    if (t.column < 0 || t.row < t.column || t.row >= n) {
      return absl::InvalidArgumentError(absl::StrCat(
          "triplet (", t.row, ", ", t.column, ") lies outside the lower triangle of n = ", n));
    }
  }
  SymmetricMatrix matrix;
  matrix.n = n;
  matrix.column_start.assign(Unsigned(n) + 1, 0);
  int last_column = -1;
  for (const Triplet& t : SortedWithDiagonal(n, triplets)) {
    if (t.column == last_column && matrix.row.back() == t.row) {
      matrix.value.back() += t.value;
      continue;
    }
    matrix.row.push_back(t.row);
    matrix.value.push_back(t.value);
    ++matrix.column_start[Unsigned(t.column) + 1];
    last_column = t.column;
  }
  for (int j = 0; j < n; ++j) {
    matrix.column_start[Unsigned(j) + 1] += matrix.column_start[Unsigned(j)];
  }
  return matrix;
}

absl::Status Validate(const SymmetricMatrix& matrix) {
  PLUMESCOUT_RETURN_IF_ERROR(ValidateStarts(matrix));
  for (int column = 0; column < matrix.n; ++column) {
    PLUMESCOUT_RETURN_IF_ERROR(ValidateColumn(matrix, column));
  }
  return absl::OkStatus();
}

void Multiply(const SymmetricMatrix& matrix, std::span<const double> x, std::span<double> y) {
  assert(x.size() == Unsigned(matrix.n) && y.size() == Unsigned(matrix.n));
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t j = 0; j < x.size(); ++j) {
    const auto begin = Unsigned(matrix.column_start[j]);
    const auto end = Unsigned(matrix.column_start[j + 1]);
    for (std::size_t k = begin; k < end; ++k) {
      const auto i = Unsigned(matrix.row[k]);
      y[i] += matrix.value[k] * x[j];
      if (i != j) y[j] += matrix.value[k] * x[i];
    }
  }
}

}  // namespace plumescout
