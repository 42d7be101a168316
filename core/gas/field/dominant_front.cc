// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/dominant_front.h"

#include <algorithm>
#include <cmath>

#include "core/linalg/dense_kernel.h"

namespace plumescout {
namespace {

constexpr std::size_t kPanel = 4;  // columns that take up all earlier ones at once

// In interleaved partial sums: chains of additions that do not wait for each other.
double Pivot(const DominantFront& front, std::size_t j) {
  constexpr std::size_t kLanes = 8;
  const double* const column = front.values + j * front.stride;
  double sum[kLanes] = {};
  std::size_t i = j + 1;
  for (; i + kLanes <= front.dominant_rows; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) sum[lane] -= column[i + lane];
  }
  for (; i < front.dominant_rows; ++i) sum[0] -= column[i];
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

// Subtracts what the columns before `begin` contribute to columns [begin, end).
void TakeUp(const DominantFront& front, std::size_t begin, std::size_t end) {
  const double* const rows = front.values + begin;
  Accumulate({.a = rows,
              .a_stride = front.stride,
              .b = rows,
              .b_row_stride = front.stride,
              .b_column_stride = 1,
              .c = front.values + begin * front.stride + begin,
              .c_stride = front.stride,
              .rows = front.rows - begin,
              .columns = end - begin,
              .depth = begin,
              .scale = -1.0,
              .lower_only = true});
}

// Right-looking within the panel [begin, end).
void EliminatePanel(const DominantFront& front, std::size_t begin, std::size_t end) {
  for (std::size_t j = begin; j < end; ++j) {
    double* const column = front.values + j * front.stride;
    column[j] = std::sqrt(Pivot(front, j));
    const double inverse = 1.0 / column[j];
    for (std::size_t i = j + 1; i < front.rows; ++i) column[i] *= inverse;
    for (std::size_t k = j + 1; k < end; ++k) {
      double* const target = front.values + k * front.stride;
      const double factor = column[k];
      for (std::size_t i = k + 1; i < front.rows; ++i) target[i] -= factor * column[i];
    }
  }
}

}  // namespace

void EliminateDominant(const DominantFront& front) {
  for (std::size_t begin = 0; begin < front.columns; begin += kPanel) {
    const std::size_t end = std::min(front.columns, begin + kPanel);
    TakeUp(front, begin, end);
    EliminatePanel(front, begin, end);
  }
  TakeUp(front, front.columns, front.unknowns);
}

}  // namespace plumescout
