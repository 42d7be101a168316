// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace plumescout {

// Small dense kernels, all column-major. Each element is summed in one fixed order without fused
// multiply-add, so that every instruction set gives the same bytes.

// Rows are handled in tiles of this many: up to kRowTile - 1 elements beyond the last row of each
// column of `a` are read, and of `c` written. A column stride of PaddedRows(rows) makes them
// padding, also for a block that begins at any row of the matrix.
inline constexpr std::size_t kRowTile = 8;
constexpr std::size_t PaddedRows(std::size_t rows) {
  return (rows + 2 * (kRowTile - 1)) / kRowTile * kRowTile;
}

// c += scale * a * b, with a: rows x depth, b: depth x columns, c: rows x columns.
struct Product {
  const double* a = nullptr;
  std::size_t a_stride = 0;
  const double* b = nullptr;  // element (k, j) at b[k * b_row_stride + j * b_column_stride]
  std::size_t b_row_stride = 1;
  std::size_t b_column_stride = 0;
  double* c = nullptr;
  std::size_t c_stride = 0;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t depth = 0;
  double scale = 1.0;
  bool lower_only = false;  // tiles wholly above the diagonal of c are left alone
  bool a_is_upper = false;  // a is 0 below its diagonal: tiles there are passed over
  bool overwrite = false;   // c = scale * a * b, whatever c was; REQUIRES: depth > 0
};
void Accumulate(const Product& product);
// What it may be on this CPU, by width of the vectors; the last is taken. For tests.
using AccumulateFunction = void (*)(const Product&);
std::vector<AccumulateFunction> AccumulateVariants();

// Factorises the first `columns` columns of the lower triangle of `front` (rows x rows) in place,
// and subtracts their outer product from the rest: L11, L21 and the Schur complement. Returns the
// first column whose pivot is not positive and finite, or `columns` if all are.
std::size_t FactorizeFront(double* front, std::size_t stride, std::size_t rows,
                           std::size_t columns);

// inverse = lower^-1 for a lower triangle of `size` rows; the strict upper triangle is set to 0.
void InvertLower(const double* lower, std::size_t lower_stride, std::size_t size, double* inverse,
                 std::size_t inverse_stride);

// The same, transposed, for a lower triangle whose inverse is wanted by rows: strictly below the
// diagonal it is set to 0. REQUIRES: inverse_stride >= size, rounded up to whole tiles.
void InvertLowerTransposed(const double* lower, std::size_t lower_stride, std::size_t size,
                           double* inverse, std::size_t inverse_stride);

// Sum of a[i] * b[i], in four interleaved partial sums: chains of additions that do not wait for
// each other.
inline double Dot(const double* a, const double* b, std::size_t size) {
  constexpr std::size_t kLanes = 4;
  double sum[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= size; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] += a[i + lane] * b[i + lane];
  }
  for (; i < size; ++i) sum[0] += a[i] * b[i];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace plumescout
