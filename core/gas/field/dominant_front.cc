// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/dominant_front.h"

#include <algorithm>
#include <cmath>

#include "core/linalg/dense_kernel.h"

namespace plumescout {
namespace {

constexpr std::size_t kPanel = 16;  // columns eliminated before the rest is updated

double Pivot(const DominantFront& front, std::size_t j) {
  const double* column = front.values + j * front.stride;
  double sum = 0.0;
  for (std::size_t i = j + 1; i < front.dominant_rows; ++i) sum -= column[i];
  return sum;
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
    EliminatePanel(front, begin, end);
    const double* const panel = front.values + begin * front.stride + end;
    Accumulate({.a = panel,
                .a_stride = front.stride,
                .b = panel,
                .b_row_stride = front.stride,
                .b_column_stride = 1,
                .c = front.values + end * front.stride + end,
                .c_stride = front.stride,
                .rows = front.rows - end,
                .columns = front.unknowns - end,
                .depth = end - begin,
                .scale = -1.0,
                .lower_only = true});
  }
}

}  // namespace plumescout
