// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/information.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/core/gas/dense_field.h"
#include "tests/core/linalg/dense_oracle.h"

namespace plumescout {
namespace information_test {

using ::plumescout::testing::DenseField;
using ::plumescout::testing::DenseReading;

GasOptions Options() {
  GasOptions options;
  options.background_mean_ppm = 7.0;
  options.background_precision_per_ppm2 = 0.02;
  return options;
}

std::vector<Evidence> EvidenceOf(const GmrfGraph& graph, const std::vector<DenseReading>& readings,
                                 const GasOptions& options) {
  std::vector<Evidence> evidence(static_cast<std::size_t>(graph.variables()));
  for (const DenseReading& r : readings) {
    evidence[ToSize(graph.At(r.cell))] +=
        {r.precision, r.precision * (r.concentration_ppm - options.background_mean_ppm)};
  }
  return evidence;
}

class InformationTest : public ::testing::TestWithParam<double> {
 protected:
  InformationTest() : rng_(17) {
    const Grid<CellState> states = testing::RandomStates(11, 9, GetParam(), rng_);
    const std::vector<DenseReading> readings = testing::RandomReadings(states, 15, rng_);
    const GmrfGraph graph(states);
    oracle_ = std::make_unique<DenseField>(states, readings, Options());
    information_ = BuildInformation(graph, EvidenceOf(graph, readings, Options()), Options());
  }
  Rng rng_;
  std::unique_ptr<DenseField> oracle_;
  Information information_;
};

TEST_P(InformationTest, HessianIsJTransposedLambdaJ) {
  ASSERT_TRUE(Validate(information_.hessian).ok());
  const Eigen::MatrixXd hessian = testing::ToDense(information_.hessian);
  // Sums of about ten terms up to 100.
  EXPECT_LE((hessian - oracle_->hessian()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(InformationTest, GradientIsThatOfTheEnergyAtTheBackground) {
  // [IPP] Eq. (3): -g = J^T Lambda (y - f(m)) = J^T Lambda y - H m at m = m_0.
  const auto n = oracle_->hessian().rows();
  const Eigen::VectorXd expected =
      oracle_->information() -
      oracle_->hessian() * Eigen::VectorXd::Constant(n, Options().background_mean_ppm);
  const Eigen::Map<const Eigen::VectorXd> found(information_.negative_gradient.data(), n);
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-10);  // terms up to 1e3
}

INSTANTIATE_TEST_SUITE_P(BlockedShares, InformationTest, ::testing::Values(0.0, 0.2, 0.5, 0.8));

TEST(InformationOfNothingTest, IsEmpty) {
  const Information information = BuildInformation(GmrfGraph(), {}, Options());
  EXPECT_EQ(information.hessian.n, 0);
  EXPECT_TRUE(Validate(information.hessian).ok());
  EXPECT_TRUE(information.negative_gradient.empty());
}

}  // namespace information_test
}  // namespace plumescout
