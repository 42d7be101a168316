// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace plumescout {

// L of a factorisation A = L L^T, by columns: the entries [begin[j], begin[j] + size[j]) of `row`
// and `value` are those of column j, the diagonal first.
struct FactorColumns {
  int n = 0;
  const int* begin = nullptr;
  const int* size = nullptr;
  const int* row = nullptr;
  double* value = nullptr;
};

// Overwrites L with the inverse of A on L's pattern, and returns the inverse's diagonal.
// Takahashi's recursion entry by entry, as in textbooks: no dense blocks. REQUIRES: the pattern is
// that of a whole factor, with every entry of fill-in.
std::vector<double> InvertOnPattern(const FactorColumns& factor);

}  // namespace plumescout
