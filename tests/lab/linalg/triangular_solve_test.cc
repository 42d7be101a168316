// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/linalg/triangular_solve.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/linalg/dense_oracle.h"

namespace plumescout::lab {
namespace triangular_solve_test {

void ExpectSolves(const SymmetricMatrix& matrix, Rng& rng) {
  const SupernodalPattern pattern = AnalyzePattern(matrix).value();
  const FactorValues factor = FactorizeSupernodes(pattern, matrix.value).value();
  const std::vector<double> b = testing::RandomVector(matrix.n, rng);
  std::vector<double> x(b.size());
  SolveSupernodes(pattern, factor, b, x);
  const Eigen::VectorXd expected =
      testing::ToDense(matrix).ldlt().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), matrix.n));
  // Condition number below 1e5: 1e5 * n * 2^-53 < 1e-8 at worst, two orders better in practice.
  const Eigen::Map<const Eigen::VectorXd> found(x.data(), matrix.n);
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.cwiseAbs().maxCoeff());
}

TEST(SolveSupernodesTest, AgreesWithADenseSolver) {
  Rng rng(21);
  for (const double share : {0.0, 0.02, 0.1, 1.0}) {
    ExpectSolves(testing::RandomPositiveDefinite(70, share, rng), rng);
  }
  ExpectSolves(testing::GridLaplacian(21, 16, 1e-3), rng);
}

TEST(SolveSupernodesTest, WorksInPlace) {
  Rng rng(22);
  const SymmetricMatrix matrix = testing::GridLaplacian(9, 9, 0.5);
  const SupernodalPattern pattern = AnalyzePattern(matrix).value();
  const FactorValues factor = FactorizeSupernodes(pattern, matrix.value).value();
  std::vector<double> values = testing::RandomVector(matrix.n, rng);
  std::vector<double> x(values.size());
  SolveSupernodes(pattern, factor, values, x);
  SolveSupernodes(pattern, factor, values, values);
  EXPECT_EQ(values, x);
}

}  // namespace triangular_solve_test
}  // namespace plumescout::lab
