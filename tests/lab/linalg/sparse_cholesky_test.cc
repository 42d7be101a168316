// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/linalg/sparse_cholesky.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "tests/core/linalg/dense_oracle.h"

namespace plumescout::lab {
namespace sparse_cholesky_test {

std::vector<double> Solution(const SparseCholesky& cholesky, const std::vector<double>& b) {
  std::vector<double> x(b.size());
  EXPECT_TRUE(cholesky.Solve(b, x).ok());
  return x;
}

// Largest residual of A x = b with |b| <= 1.
double Residual(const SymmetricMatrix& matrix, const std::vector<double>& x,
                const std::vector<double>& b) {
  std::vector<double> product(x.size());
  Multiply(matrix, x, product);
  double residual = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    residual = std::max(residual, std::abs(product[i] - b[i]));
  }
  return residual;
}

constexpr double kResidual = 1e-12;  // |A| |x| n 2^-53 for the matrices below

TEST(SparseCholeskyTest, FactorisesNewValuesOfTheSamePattern) {
  Rng rng(41);
  SymmetricMatrix matrix = testing::GridLaplacian(12, 15, 0.1);
  const std::vector<double> b = testing::RandomVector(matrix.n, rng);
  SparseCholesky cholesky;
  for (int round = 0; round < 3; ++round) {
    ASSERT_TRUE(cholesky.Factorize(matrix).ok());
    EXPECT_LE(Residual(matrix, Solution(cholesky, b), b), kResidual);
    for (double& value : matrix.value) value *= 1.5;
  }
}

TEST(SparseCholeskyTest, NoticesANewPattern) {
  Rng rng(42);
  SparseCholesky cholesky;
  for (const auto& [width, height] : {std::pair{5, 8}, {8, 5}, {20, 3}, {1, 1}}) {
    const SymmetricMatrix matrix = testing::GridLaplacian(width, height, 0.1);
    const std::vector<double> b = testing::RandomVector(matrix.n, rng);
    ASSERT_TRUE(cholesky.Factorize(matrix).ok());
    EXPECT_EQ(cholesky.n(), matrix.n);
    EXPECT_LE(Residual(matrix, Solution(cholesky, b), b), kResidual);
  }
}

TEST(SparseCholeskyTest, GivesTheSameBytesAgain) {
  Rng rng(43);
  const SymmetricMatrix matrix = testing::RandomPositiveDefinite(90, 0.05, rng);
  const std::vector<double> b = testing::RandomVector(matrix.n, rng);
  SparseCholesky first, second;
  ASSERT_TRUE(first.Factorize(testing::GridLaplacian(4, 4, 1.0)).ok());
  ASSERT_TRUE(first.Factorize(matrix).ok());
  ASSERT_TRUE(second.Factorize(matrix).ok());
  std::vector<double> variance(b.size()), variance_again(b.size());
  ASSERT_TRUE(first.InverseDiagonal(variance).ok());
  ASSERT_TRUE(second.InverseDiagonal(variance_again).ok());
  EXPECT_EQ(variance, variance_again);
  EXPECT_EQ(Solution(first, b), Solution(second, b));
}

TEST(SparseCholeskyTest, TakesTheEmptyMatrix) {
  SparseCholesky cholesky;
  ASSERT_TRUE(cholesky.Factorize(testing::GridLaplacian(3, 3, 1.0)).ok());
  ASSERT_TRUE(cholesky.Factorize(SymmetricMatrix{}).ok());
  EXPECT_TRUE(cholesky.factorized());
  EXPECT_EQ(cholesky.n(), 0);
  EXPECT_TRUE(cholesky.Solve({}, {}).ok());
  EXPECT_TRUE(cholesky.InverseDiagonal({}).ok());
}

TEST(SparseCholeskyTest, HasNoFactorAfterARefusedMatrix) {
  SparseCholesky cholesky;
  SymmetricMatrix matrix = testing::GridLaplacian(4, 4, 1.0);
  ASSERT_TRUE(cholesky.Factorize(matrix).ok());
  matrix.value[0] = -5.0;
  EXPECT_EQ(cholesky.Factorize(matrix).code(), absl::StatusCode::kFailedPrecondition);
  std::vector<double> x(16);
  EXPECT_FALSE(cholesky.factorized());
  EXPECT_EQ(cholesky.n(), 0);
  EXPECT_EQ(cholesky.Solve(x, x).code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(cholesky.InverseDiagonal(x).code(), absl::StatusCode::kFailedPrecondition);
}

TEST(SparseCholeskyTest, RecoversAfterARefusedMatrix) {
  SparseCholesky cholesky;
  SymmetricMatrix matrix = testing::GridLaplacian(4, 4, 1.0);
  matrix.value[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cholesky.Factorize(matrix).code(), absl::StatusCode::kInvalidArgument);
  matrix.value[0] = 3.0;
  EXPECT_TRUE(cholesky.Factorize(matrix).ok());
}

TEST(SparseCholeskyTest, RefusesASingularMatrix) {
  // A Laplacian without a shift has the constant vector in its kernel; exact in small integers.
  const SymmetricMatrix matrix =
      SymmetricFromTriplets(2, std::vector<Triplet>{{0, 0, 1.0}, {1, 0, -1.0}, {1, 1, 1.0}})
          .value();
  EXPECT_EQ(SparseCholesky().Factorize(matrix).code(), absl::StatusCode::kFailedPrecondition);
}

TEST(SparseCholeskyTest, RefusesVectorsOfAnotherSize) {
  SparseCholesky cholesky;
  ASSERT_TRUE(cholesky.Factorize(testing::GridLaplacian(2, 2, 1.0)).ok());
  std::vector<double> three(3), four(4);
  EXPECT_EQ(cholesky.Solve(three, four).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(cholesky.Solve(four, three).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(cholesky.InverseDiagonal(three).code(), absl::StatusCode::kInvalidArgument);
}

TEST(SparseCholeskyTest, SolvesWithHugeAndTinyValues) {
  for (const double scale : {1e-200, 1e200}) {
    SymmetricMatrix matrix = testing::GridLaplacian(6, 6, 0.1);
    for (double& value : matrix.value) value *= scale;
    SparseCholesky cholesky;
    ASSERT_TRUE(cholesky.Factorize(matrix).ok());
    std::vector<double> diagonal(36);
    ASSERT_TRUE(cholesky.InverseDiagonal(diagonal).ok());
    for (const double value : diagonal) EXPECT_GT(value * scale, 0.0);
  }
}

TEST(SparseCholeskyTest, KeepsItsFactorWhenMoved) {
  SparseCholesky cholesky;
  ASSERT_TRUE(cholesky.Factorize(testing::GridLaplacian(2, 2, 1.0)).ok());
  SparseCholesky moved = std::move(cholesky);
  EXPECT_EQ(moved.n(), 4);
}

}  // namespace sparse_cholesky_test
}  // namespace plumescout::lab
