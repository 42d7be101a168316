// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/linalg/supernodal_factor.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/linalg/dense_oracle.h"

namespace plumescout::lab {
namespace supernodal_factor_test {

// L as a dense matrix, in the order of the factor.
Eigen::MatrixXd DenseFactor(const SupernodalPattern& pattern, const FactorValues& factor) {
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(pattern.n, pattern.n);
  for (std::size_t s = 0; s < pattern.parent.size(); ++s) {
    for (std::size_t j = 0; j < pattern.columns(s); ++j) {
      for (std::size_t i = j; i < pattern.rows(s); ++i) {
        l(pattern.row[pattern.first_row[s] + i], pattern.first_column[s] + static_cast<int>(j)) =
            factor[pattern.first_value[s] + j * pattern.rows(s) + i];
      }
    }
  }
  return l;
}

Eigen::MatrixXd Permuted(const Eigen::MatrixXd& matrix, const std::vector<int>& order) {
  return matrix(order, order);
}

void ExpectFactorOf(const SymmetricMatrix& matrix) {
  const SupernodalPattern pattern = AnalyzePattern(matrix).value();
  const auto factor = FactorizeSupernodes(pattern, matrix.value);
  ASSERT_TRUE(factor.ok()) << factor.status();
  const Eigen::MatrixXd expected = Permuted(testing::ToDense(matrix), pattern.order);
  const Eigen::MatrixXd l = DenseFactor(pattern, *factor);
  // Backward error of Cholesky: n * 2^-53 * trace, below 1e-13 of the largest entry here.
  EXPECT_LE((l * l.transpose() - expected).cwiseAbs().maxCoeff(),
            1e-13 * expected.cwiseAbs().maxCoeff());
}

TEST(FactorizeSupernodesTest, TimesItsTransposeIsTheMatrix) {
  Rng rng(11);
  for (const double share : {0.0, 0.01, 0.05, 0.3, 1.0}) {
    ExpectFactorOf(testing::RandomPositiveDefinite(80, share, rng));
  }
}

TEST(FactorizeSupernodesTest, FactorisesTheLaplacianOfAGrid) {
  ExpectFactorOf(testing::GridLaplacian(25, 19, 1e-3));
}

TEST(FactorizeSupernodesTest, NamesAnUnknownOfAnIndefiniteMatrix) {
  std::vector<Triplet> triplets;
  for (int i = 0; i < 10; ++i) triplets.push_back({i, i, i == 7 ? -1.0 : 1.0});
  const SymmetricMatrix matrix = SymmetricFromTriplets(10, triplets).value();
  const auto factor = FactorizeSupernodes(AnalyzePattern(matrix).value(), matrix.value);
  EXPECT_EQ(factor.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_NE(factor.status().message().find("unknown 7"), std::string::npos);
}

}  // namespace supernodal_factor_test
}  // namespace plumescout::lab
