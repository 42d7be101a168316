// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "absl/status/statusor.h"
#include "core/linalg/symmetric_matrix.h"

namespace plumescout::lab {

// Nonzero pattern of the Cholesky factor L of P A P^T. A supernode s is a run of columns
// [first_column[s], first_column[s + 1]) that share their rows below; its values form one dense
// panel, column-major. Supernodes are in postorder of the elimination tree.
struct SupernodalPattern {
  int n = 0;
  std::vector<int> order;                // n: unknown of A at position k of L
  std::vector<int> first_column;         // supernodes + 1
  std::vector<std::size_t> first_row;    // supernodes + 1, into `row` and `parent_row`
  std::vector<std::size_t> first_value;  // supernodes + 1, into the factor's values
  std::vector<int> parent;               // supernodes; -1 at a root
  std::vector<int> child_count;          // supernodes
  std::vector<int> row;  // rows of each panel, ascending: its own columns, then the rows below
  // Place of each row in the panel of the parent; meaningless for own columns.
  std::vector<int> parent_row;

  // Entries of A by column of L: source index into A's values, row of L.
  struct Entry {
    int source = 0;
    int row = 0;
  };
  std::vector<int> first_entry;  // n + 1
  std::vector<Entry> entry;

  int supernodes() const { return static_cast<int>(parent.size()); }
  std::size_t columns(std::size_t s) const {
    return static_cast<std::size_t>(first_column[s + 1] - first_column[s]);
  }
  std::size_t rows(std::size_t s) const { return first_row[s + 1] - first_row[s]; }
};

// Orders the graph of `matrix` by approximate minimum degree and finds the supernodes of its
// factor. REQUIRES: Validate(matrix).ok(), n > 0. Errors: kResourceExhausted, kInternal.
absl::StatusOr<SupernodalPattern> AnalyzePattern(const SymmetricMatrix& matrix);

}  // namespace plumescout::lab
