// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/linalg/dense_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/types/rng.h"

namespace plumescout {
namespace dense_kernel_test {

using StridedMap = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

// Padded column-major storage with a view of what counts. The padding holds NaN, which would spread
// if a kernel took it for data.
class Padded {
 public:
  Padded(std::size_t rows, std::size_t columns)
      : stride_(PaddedRows(rows)),
        values_(stride_ * columns + kRowTile, std::numeric_limits<double>::quiet_NaN()),
        rows_(rows),
        columns_(columns) {}

  double* data() { return values_.data(); }
  std::size_t stride() const { return stride_; }
  StridedMap view() {
    return {values_.data(), static_cast<Eigen::Index>(rows_), static_cast<Eigen::Index>(columns_),
            Eigen::OuterStride<>(static_cast<Eigen::Index>(stride_))};
  }

 private:
  std::size_t stride_;
  std::vector<double> values_;
  std::size_t rows_;
  std::size_t columns_;
};

Padded RandomPadded(std::size_t rows, std::size_t columns, Rng& rng) {
  Padded matrix(rows, columns);
  for (std::size_t j = 0; j < columns; ++j) {
    for (std::size_t i = 0; i < rows; ++i) {
      matrix.data()[j * matrix.stride() + i] = rng.Uniform(-1.0, 1.0);
    }
  }
  return matrix;
}

Padded RandomFront(std::size_t rows, Rng& rng) {
  Padded front = RandomPadded(rows, rows, rng);
  const Eigen::MatrixXd factor = front.view();
  front.view() =
      factor * factor.transpose() + Eigen::MatrixXd::Identity(factor.rows(), factor.rows());
  return front;
}

struct Shape {
  std::size_t rows, columns, depth;
};

class AccumulateTest : public ::testing::TestWithParam<Shape> {};

TEST_P(AccumulateTest, AddsTheScaledProduct) {
  const auto [rows, columns, depth] = GetParam();
  Rng rng(rows + 31 * columns + 997 * depth);
  Padded a = RandomPadded(rows, depth, rng);
  Padded b = RandomPadded(depth, columns, rng);
  Padded c = RandomPadded(rows, columns, rng);
  const Eigen::MatrixXd expected = c.view() - 0.5 * (a.view() * b.view());
  Accumulate({.a = a.data(),
              .a_stride = a.stride(),
              .b = b.data(),
              .b_column_stride = b.stride(),
              .c = c.data(),
              .c_stride = c.stride(),
              .rows = rows,
              .columns = columns,
              .depth = depth,
              .scale = -0.5});
  // At most 700 products below 1: 700 * 2^-53 < 1e-12.
  EXPECT_LE((c.view() - expected).cwiseAbs().sum(),
            1e-12 * static_cast<double>(rows * columns + 1));
}

TEST_P(AccumulateTest, GivesTheSameBytesWithAnyInstructionSet) {
  const auto [rows, columns, depth] = GetParam();
  Rng rng(rows + depth);
  Padded a = RandomPadded(rows, depth, rng);
  Padded b = RandomPadded(depth, columns, rng);
  const Padded c = RandomPadded(rows, columns, rng);
  const auto result_of = [&, rows = rows, columns = columns,
                          depth = depth](AccumulateFunction accumulate) {
    Padded result = c;
    accumulate({.a = a.data(),
                .a_stride = a.stride(),
                .b = b.data(),
                .b_column_stride = b.stride(),
                .c = result.data(),
                .c_stride = result.stride(),
                .rows = rows,
                .columns = columns,
                .depth = depth});
    return result;
  };
  Padded best = result_of(Accumulate);
  for (const AccumulateFunction variant : AccumulateVariants()) {
    EXPECT_TRUE(result_of(variant).view() == best.view());
  }
}

TEST_P(AccumulateTest, TakesATransposedFactor) {
  const auto [rows, columns, depth] = GetParam();
  Rng rng(rows + columns);
  Padded a = RandomPadded(rows, depth, rng);
  Padded b = RandomPadded(columns, depth, rng);
  Padded c = RandomPadded(rows, columns, rng);
  const Eigen::MatrixXd expected = c.view() + a.view() * b.view().transpose();
  Accumulate({.a = a.data(),
              .a_stride = a.stride(),
              .b = b.data(),
              .b_row_stride = b.stride(),
              .b_column_stride = 1,
              .c = c.data(),
              .c_stride = c.stride(),
              .rows = rows,
              .columns = columns,
              .depth = depth});
  EXPECT_LE((c.view() - expected).cwiseAbs().sum(),
            1e-12 * static_cast<double>(rows * columns + 1));
}

TEST_P(AccumulateTest, OverwritesWithTheSameBytesAsItAddsToZero) {
  const auto [rows, columns, depth] = GetParam();
  if (depth == 0) return;  // not allowed
  Rng rng(rows + 7 * columns);
  Padded a = RandomPadded(rows, depth, rng);
  Padded b = RandomPadded(columns, depth, rng);
  Padded fresh(rows, columns);  // NaN so far
  Padded sum(rows, columns);
  sum.view().setZero();
  const auto product_into = [&, rows = rows, columns = columns, depth = depth](Padded& c) {
    return Product{.a = a.data(),
                   .a_stride = a.stride(),
                   .b = b.data(),
                   .b_row_stride = b.stride(),
                   .b_column_stride = 1,
                   .c = c.data(),
                   .c_stride = c.stride(),
                   .rows = rows,
                   .columns = columns,
                   .depth = depth};
  };
  Product overwriting = product_into(fresh);
  overwriting.overwrite = true;
  Accumulate(overwriting);
  Accumulate(product_into(sum));
  EXPECT_TRUE(fresh.view() == sum.view());
}

TEST_P(AccumulateTest, PassesOverTheZerosOfAnUpperTriangle) {
  const auto [rows, columns, depth] = GetParam();
  Rng rng(rows + 13 * columns);
  Padded a = RandomPadded(rows, depth, rng);
  for (std::size_t k = 0; k < depth; ++k) {
    for (std::size_t i = k + 1; i < rows; ++i) a.data()[k * a.stride() + i] = 0.0;
  }
  Padded b = RandomPadded(depth, columns, rng);
  Padded all = RandomPadded(rows, columns, rng);
  Padded some = all;
  const auto product_into = [&, rows = rows, columns = columns, depth = depth](Padded& c) {
    return Product{.a = a.data(),
                   .a_stride = a.stride(),
                   .b = b.data(),
                   .b_column_stride = b.stride(),
                   .c = c.data(),
                   .c_stride = c.stride(),
                   .rows = rows,
                   .columns = columns,
                   .depth = depth};
  };
  Product upper = product_into(some);
  upper.a_is_upper = true;
  Accumulate(upper);
  Accumulate(product_into(all));
  EXPECT_TRUE(some.view() == all.view());
}

INSTANTIATE_TEST_SUITE_P(Shapes, AccumulateTest,
                         ::testing::Values(Shape{1, 1, 1}, Shape{8, 4, 1}, Shape{7, 3, 5},
                                           Shape{9, 5, 40}, Shape{64, 17, 256}, Shape{30, 6, 257},
                                           Shape{3, 2, 700}, Shape{5, 5, 0}, Shape{0, 3, 2},
                                           Shape{290, 4, 280}));

TEST(AccumulateLowerTest, EqualsTheFullProductBelowTheDiagonal) {
  constexpr std::size_t kRows = 29;
  Rng rng(5);
  Padded a = RandomPadded(kRows, 6, rng);
  Padded c = RandomPadded(kRows, kRows, rng);
  const Eigen::MatrixXd expected = c.view() + a.view() * a.view().transpose();
  Accumulate({.a = a.data(),
              .a_stride = a.stride(),
              .b = a.data(),
              .b_row_stride = a.stride(),
              .b_column_stride = 1,
              .c = c.data(),
              .c_stride = c.stride(),
              .rows = kRows,
              .columns = kRows,
              .depth = 6,
              .lower_only = true});
  const Eigen::MatrixXd difference = c.view() - expected;
  EXPECT_LE(Eigen::MatrixXd(difference.triangularView<Eigen::Lower>()).cwiseAbs().maxCoeff(),
            1e-14);
}

class FactorizeFrontTest : public ::testing::TestWithParam<Shape> {};

TEST_P(FactorizeFrontTest, LeavesTheFactorAndTheSchurComplement) {
  const auto [rows, columns, unused] = GetParam();
  Rng rng(rows * 7 + columns);
  Padded front = RandomFront(rows, rng);
  const Eigen::MatrixXd original = front.view();
  ASSERT_EQ(FactorizeFront(front.data(), front.stride(), rows, columns), columns);

  const auto k = static_cast<Eigen::Index>(columns);
  const auto rest = static_cast<Eigen::Index>(rows) - k;
  const Eigen::MatrixXd l11 = original.topLeftCorner(k, k).llt().matrixL();
  const Eigen::MatrixXd l21 = original.bottomLeftCorner(rest, k) * l11.inverse().transpose();
  const Eigen::MatrixXd schur = original.bottomRightCorner(rest, rest) - l21 * l21.transpose();
  const auto lower_error = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    if (a.size() == 0) return 0.0;
    return Eigen::MatrixXd((a - b).triangularView<Eigen::Lower>()).cwiseAbs().maxCoeff();
  };
  // Entries up to 100, condition below 1e3.
  EXPECT_LE(lower_error(front.view().topLeftCorner(k, k), l11), 1e-11);
  EXPECT_LE((front.view().bottomLeftCorner(rest, k) - l21).cwiseAbs().sum(), 1e-9);
  EXPECT_LE(lower_error(front.view().bottomRightCorner(rest, rest), schur), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FactorizeFrontTest,
                         ::testing::Values(Shape{1, 1, 0}, Shape{12, 1, 0}, Shape{9, 9, 0},
                                           Shape{40, 23, 0}, Shape{50, 24, 0}, Shape{90, 61, 0}));

TEST(FactorizeFrontTest, NamesTheFirstColumnWithoutAPositivePivot) {
  for (const double pivot : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    Padded front(30, 30);
    front.view() = Eigen::MatrixXd::Identity(30, 30);
    front.view()(27, 27) = pivot;
    EXPECT_EQ(FactorizeFront(front.data(), front.stride(), 30, 30), 27U) << pivot;
  }
}

TEST(InvertLowerTest, TimesTheTriangleIsTheIdentity) {
  constexpr std::size_t kSize = 37;
  Rng rng(9);
  Padded lower = RandomFront(kSize, rng);
  ASSERT_EQ(FactorizeFront(lower.data(), lower.stride(), kSize, kSize), kSize);
  Padded inverse(kSize, kSize);
  InvertLower(lower.data(), lower.stride(), kSize, inverse.data(), inverse.stride());
  const Eigen::MatrixXd triangle = lower.view().triangularView<Eigen::Lower>();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(kSize, kSize);
  EXPECT_LE((triangle * inverse.view() - identity).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(InvertLowerTransposedTest, TransposesTheInverse) {
  for (const std::size_t size : {1, 3, 4, 8, 13, 37, 48}) {
    Rng rng(size);
    Padded lower = RandomFront(size, rng);
    ASSERT_EQ(FactorizeFront(lower.data(), lower.stride(), size, size), size);
    Padded inverse(size, size);
    InvertLower(lower.data(), lower.stride(), size, inverse.data(), inverse.stride());
    Padded transposed(size, size);
    InvertLowerTransposed(lower.data(), lower.stride(), size, transposed.data(),
                          transposed.stride());
    const Eigen::MatrixXd difference = transposed.view() - inverse.view().transpose();
    EXPECT_LE(difference.cwiseAbs().maxCoeff(), 1e-12) << size;
    EXPECT_TRUE(Eigen::MatrixXd(transposed.view().triangularView<Eigen::StrictlyLower>()).isZero(0))
        << size;
  }
}

TEST(DotTest, SumsProductsOfAnyLength) {
  std::vector<double> a, b;
  double expected = 0.0;
  for (int i = 0; i < 23; ++i) {
    EXPECT_EQ(Dot(a.data(), b.data(), a.size()), expected);  // small integers: exact
    a.push_back(i);
    b.push_back(3 - i);
    expected += i * (3.0 - i);
  }
}

}  // namespace dense_kernel_test
}  // namespace plumescout
