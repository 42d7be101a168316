// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/linalg/selected_inverse.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/linalg/dense_oracle.h"

namespace plumescout::lab {
namespace selected_inverse_test {

void ExpectInverseDiagonal(const SymmetricMatrix& matrix) {
  const SupernodalPattern pattern = AnalyzePattern(matrix).value();
  const FactorValues factor = FactorizeSupernodes(pattern, matrix.value).value();
  std::vector<double> diagonal(static_cast<std::size_t>(matrix.n));
  InverseDiagonalSupernodes(pattern, factor, diagonal);
  const Eigen::MatrixXd inverse = testing::ToDense(matrix).inverse();
  for (int i = 0; i < matrix.n; ++i) {
    // Condition number below 1e5, as for solving.
    EXPECT_NEAR(diagonal[static_cast<std::size_t>(i)] / inverse(i, i), 1.0, 1e-10) << i;
  }
}

TEST(InverseDiagonalSupernodesTest, AgreesWithTheDenseInverseOfRandomMatrices) {
  Rng rng(31);
  for (const double share : {0.0, 0.01, 0.03, 0.1, 0.4, 1.0}) {
    ExpectInverseDiagonal(testing::RandomPositiveDefinite(75, share, rng));
  }
}

TEST(InverseDiagonalSupernodesTest, AgreesWithTheDenseInverseOfAGrid) {
  ExpectInverseDiagonal(testing::GridLaplacian(27, 22, 1e-3));
}

TEST(InverseDiagonalSupernodesTest, HandlesAChain) {
  ExpectInverseDiagonal(testing::GridLaplacian(60, 1, 1e-2));
}

TEST(InverseDiagonalSupernodesTest, OfADiagonalMatrixIsItsReciprocal) {
  const SymmetricMatrix matrix =
      SymmetricFromTriplets(3, std::vector<Triplet>{{0, 0, 2.0}, {1, 1, 4.0}, {2, 2, 8.0}}).value();
  const SupernodalPattern pattern = AnalyzePattern(matrix).value();
  const FactorValues factor = FactorizeSupernodes(pattern, matrix.value).value();
  std::vector<double> diagonal(3);
  InverseDiagonalSupernodes(pattern, factor, diagonal);
  EXPECT_DOUBLE_EQ(diagonal[0], 0.5);
  EXPECT_DOUBLE_EQ(diagonal[1], 0.25);
  EXPECT_DOUBLE_EQ(diagonal[2], 0.125);
}

}  // namespace selected_inverse_test
}  // namespace plumescout::lab
