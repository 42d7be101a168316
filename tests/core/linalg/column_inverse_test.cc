// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/linalg/column_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "tests/core/linalg/dense_oracle.h"

namespace plumescout {
namespace column_inverse_test {

TEST(ColumnInverse, IsTheInverseOnThePatternOfTheFactor) {
  // All of the lower triangle: the whole inverse is asked for.
  Rng rng(9);
  const Eigen::MatrixXd a = testing::ToDense(testing::RandomPositiveDefinite(12, 0.5, rng));
  const Eigen::MatrixXd l = a.llt().matrixL();
  std::vector<int> begin, size, row;
  std::vector<double> value;
  for (int j = 0; j < 12; ++j) {
    begin.push_back(static_cast<int>(row.size()));
    size.push_back(12 - j);
    for (int i = j; i < 12; ++i) {
      row.push_back(i);
      value.push_back(l(i, j));
    }
  }
  const std::vector<double> diagonal =
      InvertOnPattern({12, begin.data(), size.data(), row.data(), value.data()});
  const Eigen::MatrixXd inverse = a.inverse();
  for (int j = 0; j < 12; ++j) {
    EXPECT_NEAR(diagonal[static_cast<std::size_t>(j)], inverse(j, j), 1e-12);
    for (int i = j; i < 12; ++i) {
      const auto at = static_cast<std::size_t>(begin[static_cast<std::size_t>(j)] + i - j);
      EXPECT_NEAR(value[at], inverse(i, j), 1e-12);
    }
  }
}

TEST(ColumnInverse, OfASparseFactorTakesNoMoreThanItsPattern) {
  // A chain of three: L has no entry between the first and the last.
  std::vector<double> value = {1.0, -0.5, 1.0, -0.5, 1.0};
  const std::vector<int> begin = {0, 2, 4}, size = {2, 2, 1}, row = {0, 1, 1, 2, 2};
  Eigen::Matrix3d l;
  l << 1.0, 0.0, 0.0, -0.5, 1.0, 0.0, 0.0, -0.5, 1.0;
  const Eigen::Matrix3d inverse = (l * l.transpose()).inverse();
  const std::vector<double> diagonal =
      InvertOnPattern({3, begin.data(), size.data(), row.data(), value.data()});
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(diagonal[static_cast<std::size_t>(j)], inverse(j, j), 1e-14);
  }
  EXPECT_NEAR(value[1], inverse(1, 0), 1e-14);
  EXPECT_NEAR(value[3], inverse(2, 1), 1e-14);
}

}  // namespace column_inverse_test
}  // namespace plumescout
