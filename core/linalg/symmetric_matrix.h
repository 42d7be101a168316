// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace plumescout {

// Sparse symmetric n x n matrix: its lower triangle by columns. Column j holds the entries
// [column_start[j], column_start[j + 1]) of `row` and `value`, rows ascending, the diagonal first.
struct SymmetricMatrix {
  int n = 0;
  std::vector<int> column_start = {0};  // n + 1
  std::vector<int> row;
  std::vector<double> value;
};

struct Triplet {
  int row = 0;
  int column = 0;
  double value = 0.0;
};

// The matrix whose lower triangle is the sum of `triplets`, in any order. Diagonal entries that no
// triplet names are stored as 0. Errors: kInvalidArgument if an index lies outside the lower
// triangle of n x n.
absl::StatusOr<SymmetricMatrix> SymmetricFromTriplets(int n, std::span<const Triplet> triplets);

// kInvalidArgument, naming the place, if the arrays are not as described above or a value is not
// finite. Cost: O(entries).
absl::Status Validate(const SymmetricMatrix& matrix);

// y = A x. REQUIRES: x and y hold n values and do not overlap.
void Multiply(const SymmetricMatrix& matrix, std::span<const double> x, std::span<double> y);

}  // namespace plumescout
