// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/dominant_front.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstddef>
#include <vector>

#include "core/linalg/dense_kernel.h"
#include "core/types/rng.h"

namespace plumescout {
namespace dominant_front_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A random diagonally dominant M-matrix with right-hand side, and the same as a front.
struct Example {
  Example(Index unknowns, double excess_scale, Rng& rng)
      : matrix(MatrixXd::Zero(unknowns, unknowns)), excess(unknowns), right_hand_side(unknowns) {
    for (Index j = 0; j < unknowns; ++j) {
      for (Index i = j + 1; i < unknowns; ++i) {
        if (rng.Uniform01() < 0.6) matrix(i, j) = matrix(j, i) = -rng.Uniform(0.1, 3.0);
      }
      excess(j) = excess_scale * rng.Uniform(0.5, 1.0);
      right_hand_side(j) = rng.Uniform(-5.0, 5.0);
    }
    for (Index j = 0; j < unknowns; ++j) matrix(j, j) = excess(j) - matrix.row(j).sum();
    Pack();
  }

  void Pack() {
    const auto unknowns = static_cast<std::size_t>(matrix.rows());
    stride = PaddedRows(unknowns + 2);
    values.assign(stride * unknowns, 0.0);
    for (std::size_t j = 0; j < unknowns; ++j) {
      for (std::size_t i = j + 1; i < unknowns; ++i) {
        values[j * stride + i] = matrix(static_cast<Index>(i), static_cast<Index>(j));
      }
      values[j * stride + unknowns] = -excess(static_cast<Index>(j));
      values[j * stride + unknowns + 1] = right_hand_side(static_cast<Index>(j));
    }
  }

  void Eliminate(Index columns) {
    const auto unknowns = static_cast<std::size_t>(matrix.rows());
    EliminateDominant({.values = values.data(),
                       .stride = stride,
                       .rows = unknowns + 2,
                       .dominant_rows = unknowns + 1,
                       .unknowns = unknowns,
                       .columns = static_cast<std::size_t>(columns)});
  }
  double At(Index row, Index column) const {
    return values[static_cast<std::size_t>(column) * stride + static_cast<std::size_t>(row)];
  }

  MatrixXd matrix;
  VectorXd excess;
  VectorXd right_hand_side;
  std::size_t stride = 0;
  std::vector<double> values;
};

TEST(EliminateDominantTest, GivesTheCholeskyFactorOfAWholeMatrix) {
  Rng rng(1);
  for (const Index unknowns : {1, 2, 7, 16, 17, 50}) {
    Example example(unknowns, 0.5, rng);
    example.Eliminate(unknowns);
    const MatrixXd lower = example.matrix.llt().matrixL();
    for (Index j = 0; j < unknowns; ++j) {
      for (Index i = j; i < unknowns; ++i) EXPECT_NEAR(example.At(i, j), lower(i, j), 1e-12);
    }
    const VectorXd forward = lower.triangularView<Eigen::Lower>().solve(example.right_hand_side);
    for (Index j = 0; j < unknowns; ++j) {
      EXPECT_NEAR(example.At(unknowns + 1, j), forward(j), 1e-11);
    }
  }
}

TEST(EliminateDominantTest, LeavesTheSchurComplementInTheSameForm) {
  Rng rng(2);
  constexpr Index kUnknowns = 41;
  for (const Index columns : {0, 1, 15, 16, 40}) {
    Example example(kUnknowns, 0.5, rng);
    example.Eliminate(columns);
    const Index rest = kUnknowns - columns;
    const MatrixXd inverse = example.matrix.topLeftCorner(columns, columns).inverse();
    const MatrixXd below = example.matrix.bottomLeftCorner(rest, columns);
    const MatrixXd schur =
        example.matrix.bottomRightCorner(rest, rest) - below * inverse * below.transpose();
    const VectorXd side = example.right_hand_side.tail(rest) -
                          below * inverse * example.right_hand_side.head(columns);
    for (Index j = 0; j < rest; ++j) {
      for (Index i = j + 1; i < rest; ++i) {
        EXPECT_NEAR(example.At(columns + i, columns + j), schur(i, j), 1e-11);
      }
      EXPECT_NEAR(-example.At(kUnknowns, columns + j), schur.row(j).sum(), 1e-11);
      EXPECT_NEAR(example.At(kUnknowns + 1, columns + j), side(j), 1e-11);
    }
  }
}

TEST(EliminateDominantTest, LosesNoDigitsOnANearlySingularMatrix) {
  // In a chain of unit links of which only the last is grounded, by g, every pivot but the last is
  // 1 and the last is g: subtracting diagonals would find 1 + g - 1.
  constexpr Index kUnknowns = 30;
  constexpr double kGround = 1e-20;
  Rng rng(3);
  Example example(kUnknowns, 0.0, rng);
  example.matrix.setZero();
  for (Index j = 0; j + 1 < kUnknowns; ++j) example.matrix(j + 1, j) = -1.0;
  example.excess(kUnknowns - 1) = kGround;
  example.Pack();
  example.Eliminate(kUnknowns);
  const double pivot = example.At(kUnknowns - 1, kUnknowns - 1);
  EXPECT_NEAR(pivot * pivot / kGround, 1.0, 1e-14);
}

}  // namespace dominant_front_test
}  // namespace plumescout
