// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/linalg/cholmod_solve.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "tests/core/linalg/dense_oracle.h"

namespace plumescout {
namespace cholmod_solve_test {

absl::StatusCode CodeOf(const SymmetricMatrix& matrix, std::size_t values) {
  return SolveByCholmod(matrix, std::vector<double>(values)).status().code();
}

TEST(CholmodSolve, AgreesWithADenseInverse) {
  Rng rng(5);
  std::vector<SymmetricMatrix> matrices = {testing::GridLaplacian(17, 13, 0.1),
                                           testing::GridLaplacian(1, 1, 0.5)};
  for (const double share : {0.0, 0.02, 0.1, 0.6}) {
    matrices.push_back(testing::RandomPositiveDefinite(60, share, rng));
  }
  for (const SymmetricMatrix& matrix : matrices) {
    const std::vector<double> b = testing::RandomVector(matrix.n, rng);
    const auto solution = SolveByCholmod(matrix, b);
    ASSERT_TRUE(solution.ok()) << solution.status();
    const Eigen::MatrixXd inverse = testing::ToDense(matrix).inverse();
    const Eigen::VectorXd x = inverse * Eigen::Map<const Eigen::VectorXd>(b.data(), matrix.n);
    for (int i = 0; i < matrix.n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      EXPECT_NEAR(solution->x[k], x(i), 1e-11);
      EXPECT_NEAR(solution->inverse_diagonal[k], inverse(i, i), 1e-11);
    }
  }
}

TEST(CholmodSolve, OfNothingIsNothing) {
  const auto solution = SolveByCholmod(SymmetricMatrix(), {});
  ASSERT_TRUE(solution.ok()) << solution.status();
  EXPECT_TRUE(solution->x.empty());
}

TEST(CholmodSolve, RefusesWhatItCannotSolve) {
  SymmetricMatrix matrix = testing::GridLaplacian(3, 2, 0.1);
  EXPECT_EQ(CodeOf(matrix, 5), absl::StatusCode::kInvalidArgument);
  matrix.value[0] = -1.0;
  EXPECT_EQ(CodeOf(matrix, 6), absl::StatusCode::kFailedPrecondition);
  matrix.value[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(CodeOf(matrix, 6), absl::StatusCode::kInvalidArgument);
}

}  // namespace cholmod_solve_test
}  // namespace plumescout
