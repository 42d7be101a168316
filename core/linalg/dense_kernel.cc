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
constexpr int kAvx512Bytes = 64;

template <int kBytes>
struct VectorOf {
  typedef double Type __attribute__((vector_size(kBytes)));
};

// kColumnTile elements of b, row by row.
struct ColumnsOfB {
  const double* values = nullptr;
  std::size_t row_stride = 0;
};

// One tile of a product: kRowTile x kColumnTile elements of c, or fewer columns.
struct TileOfProduct {
  const double* a = nullptr;
  std::size_t a_stride = 0;
  const double* b = nullptr;  // kColumnTile elements each b_stride
  std::size_t b_stride = 0;
  std::size_t depth = 0;
  double* c = nullptr;
  std::size_t c_stride = 0;
  std::size_t columns = 0;
  double scale = 1.0;
  bool overwrite = false;
};

// Kept in registers over all columns of a.
template <int kBytes>
[[gnu::always_inline]] inline void Accumulate(TileOfProduct t) {
  using Vector = typename VectorOf<kBytes>::Type;
  constexpr std::size_t kLanes = kBytes / sizeof(double);
  constexpr std::size_t kParts = kRowTile / kLanes;
  Vector sum[kColumnTile][kParts] = {};
  for (std::size_t k = 0; k < t.depth; ++k, t.a += t.a_stride, t.b += t.b_stride) {
    for (std::size_t part = 0; part < kParts; ++part) {
      Vector x;
      std::memcpy(&x, t.a + part * kLanes, sizeof(x));
      for (std::size_t j = 0; j < kColumnTile; ++j) sum[j][part] += x * t.b[j];
    }
  }
  for (std::size_t j = 0; j < t.columns; ++j, t.c += t.c_stride) {
    for (std::size_t part = 0; part < kParts; ++part) {
      Vector x = {};
      if (!t.overwrite) std::memcpy(&x, t.c + part * kLanes, sizeof(x));
      x += t.scale * sum[j][part];
      std::memcpy(t.c + part * kLanes, &x, sizeof(x));
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
      const bool in_place = p.b_column_stride == 1 && columns == kColumnTile;
      if (!in_place) PackColumns(p, k, depth, column, columns, packed);
      const double* const b = in_place ? p.b + k * p.b_row_stride + column : packed;
      const std::size_t b_stride = in_place ? p.b_row_stride : kColumnTile;
      const std::size_t first = p.lower_only ? column / kRowTile * kRowTile : 0;
      for (std::size_t row = first; row < p.rows; row += kRowTile) {
        const std::size_t zeros = p.a_is_upper && row > k ? std::min(depth, row - k) : 0;
        Accumulate<kBytes>({.a = p.a + (k + zeros) * p.a_stride + row,
                            .a_stride = p.a_stride,
                            .b = b + zeros * b_stride,
                            .b_stride = b_stride,
                            .depth = depth - zeros,
                            .c = p.c + column * p.c_stride + row,
                            .c_stride = p.c_stride,
                            .columns = columns,
                            .scale = p.scale,
                            .overwrite = p.overwrite && k == 0});
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
