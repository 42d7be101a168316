// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/linalg/dense_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace plumescout {
namespace {

constexpr std::size_t kColumnTile = 4;  // with kRowTile: 8 accumulators of 4 doubles
constexpr std::size_t kDepth = 256;     // of a tile at once: 16 KiB of a, 8 KiB of b
constexpr std::size_t kPanel = 24;      // columns factorised before the rest is updated

// Widths of vector registers.
constexpr int kPortableBytes = 16;
constexpr int kAvx2Bytes = 32;

template <int kBytes>
struct VectorOf {
  typedef double Type __attribute__((vector_size(kBytes)));
};

// One kRowTile x kColumnTile tile of c, kept in registers over `depth` columns of a. `b` is packed:
// kColumnTile values for each of them.
template <int kBytes>
[[gnu::always_inline]] inline void Tile(const Product& p, const double* a, const double* b,
                                        std::size_t depth, double* c, std::size_t columns) {
  using Vector = typename VectorOf<kBytes>::Type;
  constexpr std::size_t kLanes = kBytes / sizeof(double);
  constexpr std::size_t kParts = kRowTile / kLanes;
  Vector sum[kColumnTile][kParts] = {};
  for (std::size_t k = 0; k < depth; ++k, a += p.a_stride, b += kColumnTile) {
    for (std::size_t part = 0; part < kParts; ++part) {
      Vector x;
      std::memcpy(&x, a + part * kLanes, sizeof(x));
      for (std::size_t j = 0; j < kColumnTile; ++j) sum[j][part] += x * b[j];
    }
  }
  for (std::size_t j = 0; j < columns; ++j, c += p.c_stride) {
    for (std::size_t part = 0; part < kParts; ++part) {
      Vector x;
      std::memcpy(&x, c + part * kLanes, sizeof(x));
      x += p.scale * sum[j][part];
      std::memcpy(c + part * kLanes, &x, sizeof(x));
    }
  }
}

// The columns of a tile, for rows [k, k + depth) of b; absent columns are 0.
void PackColumns(const Product& p, std::size_t k, std::size_t depth, std::size_t column,
                 std::size_t columns, double* packed) {
  const double* b = p.b + k * p.b_row_stride + column * p.b_column_stride;
  for (std::size_t i = 0; i < depth; ++i, b += p.b_row_stride) {
    for (std::size_t j = 0; j < kColumnTile; ++j) {
      packed[i * kColumnTile + j] = j < columns ? b[j * p.b_column_stride] : 0.0;
    }
  }
}

template <int kBytes>
[[gnu::always_inline]] inline void AccumulateBody(const Product& p) {
  double packed[kDepth * kColumnTile];
  for (std::size_t k = 0; k < p.depth; k += kDepth) {
    const std::size_t depth = std::min(kDepth, p.depth - k);
    for (std::size_t column = 0; column < p.columns; column += kColumnTile) {
      const std::size_t columns = std::min(kColumnTile, p.columns - column);
      PackColumns(p, k, depth, column, columns, packed);
      const std::size_t first = p.lower_only ? column / kRowTile * kRowTile : 0;
      for (std::size_t row = first; row < p.rows; row += kRowTile) {
        Tile<kBytes>(p, p.a + k * p.a_stride + row, packed, depth, p.c + column * p.c_stride + row,
                     columns);
      }
    }
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void AccumulateAvx2(const Product& p) { AccumulateBody<kAvx2Bytes>(p); }
#endif

using AccumulateFunction = void (*)(const Product&);

AccumulateFunction BestAccumulate() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return AccumulateAvx2;
#endif
  return AccumulatePortably;
}

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

void Accumulate(const Product& product) {
  static const AccumulateFunction accumulate = BestAccumulate();
  accumulate(product);
}

void AccumulatePortably(const Product& product) { AccumulateBody<kPortableBytes>(product); }

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

double Dot(const double* a, const double* b, std::size_t size) {
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
