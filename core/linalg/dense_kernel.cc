// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/linalg/dense_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace plumescout {
namespace {

constexpr std::size_t kColumnTile = 4;
constexpr std::size_t kDepth = 256;  // of a tile at once: 16 KiB of a
constexpr std::size_t kPanel = 24;   // columns factorised before the rest is updated

// Widths of vector registers.
constexpr int kPortableBytes = 16;
constexpr int kAvx2Bytes = 32;
constexpr int kAvx512Bytes = 64;

template <int kBytes>
struct VectorOf {
  typedef double Type __attribute__((vector_size(kBytes)));
};

// Rows [k, k + depth) of b, and columns [column, column + columns), of a product.
struct PartOfProduct {
  std::size_t k = 0;
  std::size_t depth = 0;
  std::size_t column = 0;
  std::size_t columns = 0;
};

// Of kRowTile rows from `row` on, in registers over all columns of a. Where the part has fewer
// columns than kColumns, those that lack are taken for its last, and left out in the end.
template <int kBytes, std::size_t kColumns>
[[gnu::always_inline]] inline void AccumulateTile(const Product& p, const PartOfProduct& part,
                                                  std::size_t row) {
  using Vector = typename VectorOf<kBytes>::Type;
  constexpr std::size_t kLanes = kBytes / sizeof(double);
  constexpr std::size_t kParts = kRowTile / kLanes;
  const std::size_t zeros = p.a_is_upper && row > part.k ? std::min(part.depth, row - part.k) : 0;
  const std::size_t first = part.k + zeros;
  const double* a = p.a + first * p.a_stride + row;
  std::array<const double*, kColumns> b;
  b[0] = p.b + first * p.b_row_stride + part.column * p.b_column_stride;
  for (std::size_t j = 1; j < kColumns; ++j) {
    b[j] = b[j - 1] + (j < part.columns ? p.b_column_stride : 0);
  }
  Vector sum[kColumns][kParts] = {};
  std::size_t at = 0;
  for (std::size_t k = zeros; k < part.depth; ++k, a += p.a_stride, at += p.b_row_stride) {
    for (std::size_t i = 0; i < kParts; ++i) {
      Vector x;
      std::memcpy(&x, a + i * kLanes, sizeof(x));
      for (std::size_t j = 0; j < kColumns; ++j) sum[j][i] += x * b[j][at];
    }
  }
  const bool overwrite = p.overwrite && part.k == 0;
  double* c = p.c + part.column * p.c_stride + row;
  for (std::size_t j = 0; j < kColumns; ++j, c += p.c_stride) {
    if (j == part.columns) break;  // unrolled: a register is not chosen by a variable
    for (std::size_t i = 0; i < kParts; ++i) {
      Vector x = {};
      if (!overwrite) std::memcpy(&x, c + i * kLanes, sizeof(x));
      x += p.scale * sum[j][i];
      std::memcpy(c + i * kLanes, &x, sizeof(x));
    }
  }
}

template <int kBytes, std::size_t kColumns>
[[gnu::always_inline]] inline void AccumulatePart(const Product& p, const PartOfProduct& part) {
  const std::size_t first = p.lower_only ? part.column / kRowTile * kRowTile : 0;
  for (std::size_t row = first; row < p.rows; row += kRowTile) {
    AccumulateTile<kBytes, kColumns>(p, part, row);
  }
}

// A tile of the widest registers has twice the columns: sums enough that none waits for itself. `p`
// is a copy, which no write to c can change.
template <int kBytes>
[[gnu::always_inline]] inline void AccumulateBody(Product p) {
  constexpr std::size_t kMost = kBytes == kAvx512Bytes ? 2 * kColumnTile : kColumnTile;
  for (std::size_t k = 0; k < p.depth; k += kDepth) {
    PartOfProduct part = {k, std::min(kDepth, p.depth - k), 0, 0};
    for (; part.column < p.columns; part.column += part.columns) {
      part.columns = std::min(kMost, p.columns - part.column);
      if (part.columns > kColumnTile) {
        AccumulatePart<kBytes, kMost>(p, part);
      } else {
        AccumulatePart<kBytes, kColumnTile>(p, part);
      }
    }
  }
}

void AccumulatePortably(const Product& p) { AccumulateBody<kPortableBytes>(p); }

#if defined(__x86_64__)
[[gnu::target("avx2")]] void AccumulateAvx2(const Product& p) { AccumulateBody<kAvx2Bytes>(p); }
[[gnu::target("avx512f")]] void AccumulateAvx512(const Product& p) {
  AccumulateBody<kAvx512Bytes>(p);
}
#endif

// y -= factor * x
void SubtractScaled(double factor, const double* x, double* y, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) y[i] -= factor * x[i];
}

// Right-looking within the panel [begin, end): scales each column and updates those to its right.
std::size_t FactorizePanel(double* front, std::size_t stride, std::size_t rows, std::size_t begin,
                           std::size_t end) {
  for (std::size_t j = begin; j < end; ++j) {
    double* column = front + j * stride;
    if (!(column[j] > 0.0) || !std::isfinite(column[j])) return j;
    column[j] = std::sqrt(column[j]);
    const double inverse = 1.0 / column[j];
    for (std::size_t i = j + 1; i < rows; ++i) column[i] *= inverse;
    for (std::size_t k = j + 1; k < end; ++k) {
      SubtractScaled(column[k], column + k, front + k * stride + k, rows - k);
    }
  }
  return end;
}

}  // namespace

std::vector<AccumulateFunction> AccumulateVariants() {
  std::vector<AccumulateFunction> variants = {AccumulatePortably};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) variants.push_back(AccumulateAvx2);
  if (__builtin_cpu_supports("avx512f")) variants.push_back(AccumulateAvx512);
#endif
  return variants;
}

void Accumulate(const Product& product) {
  static const AccumulateFunction best = AccumulateVariants().back();
  best(product);
}

std::size_t FactorizeFront(double* front, std::size_t stride, std::size_t rows,
                           std::size_t columns) {
  for (std::size_t begin = 0; begin < columns; begin += kPanel) {
    const std::size_t end = std::min(columns, begin + kPanel);
    const std::size_t failed = FactorizePanel(front, stride, rows, begin, end);
    if (failed != end) return failed;
    const double* panel = front + begin * stride + end;
    Accumulate({.a = panel,
                .a_stride = stride,
                .b = panel,
                .b_row_stride = stride,
                .b_column_stride = 1,
                .c = front + end * stride + end,
                .c_stride = stride,
                .rows = rows - end,
                .columns = rows - end,
                .depth = end - begin,
                .scale = -1.0,
                .lower_only = true});
  }
  return columns;
}

void InvertLower(const double* lower, std::size_t lower_stride, std::size_t size, double* inverse,
                 std::size_t inverse_stride) {
  for (std::size_t j = 0; j < size; ++j) {
    double* x = inverse + j * inverse_stride;
    std::fill(x, x + size, 0.0);
    x[j] = 1.0;
    for (std::size_t k = j; k < size; ++k) {
      const double* column = lower + k * lower_stride;
      x[k] /= column[k];
      SubtractScaled(x[k], column + k + 1, x + k + 1, size - k - 1);
    }
  }
}

void InvertLowerTransposed(const double* lower, std::size_t lower_stride, std::size_t size,
                           double* inverse, std::size_t inverse_stride) {
  std::fill(inverse, inverse + inverse_stride * size, 0.0);
  for (std::size_t begin = 0; begin < size; begin += kColumnTile) {
    const std::size_t end = std::min(size, begin + kColumnTile);
    // Rows [begin, end) of L X = 1, as columns: what earlier rows of X contribute, then the rest.
    Accumulate({.a = inverse,
                .a_stride = inverse_stride,
                .b = lower + begin,
                .b_row_stride = lower_stride,
                .b_column_stride = 1,
                .c = inverse + begin * inverse_stride,
                .c_stride = inverse_stride,
                .rows = begin,
                .columns = end - begin,
                .depth = begin,
                .scale = -1.0,
                .a_is_upper = true});
    for (std::size_t j = begin; j < end; ++j) {
      double* const x = inverse + j * inverse_stride;
      x[j] = 1.0;
      for (std::size_t k = begin; k < j; ++k) {
        SubtractScaled(lower[k * lower_stride + j], inverse + k * inverse_stride, x, k + 1);
      }
      const double scale = 1.0 / lower[j * lower_stride + j];
      for (std::size_t i = 0; i <= j; ++i) x[i] *= scale;
    }
  }
}

}  // namespace plumescout
