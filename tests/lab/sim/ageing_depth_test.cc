// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/ageing_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumescout::lab {
namespace ageing_depth_test {

TEST(AgeingDepthTest, StartsAsAThreeDimensionalGaussianAndEndsAtTheMixingDepth) {
  const GasParameters gas;
  EXPECT_NEAR(DepthAtAge_m(gas, 0.0), std::sqrt(2.0 * M_PI) * 0.1, 1e-12);
  // sigma^2 + 2 K age = 0.01 + (0.0015 + 0.04) * 10 m^2.
  EXPECT_NEAR(DepthAtAge_m(gas, 10.0), std::sqrt(2.0 * M_PI * 0.425), 1e-12);
  EXPECT_EQ(DepthAtAge_m(gas, 1000.0), 2.05);
}

// Largest relative error of the sum of decays, at any age.
double WorstError(const GasParameters& gas) {
  const std::vector<DecayTerm> terms = InverseDepthTerms(gas);
  double worst = 0.0;
  for (double age_s = 1e-3; age_s < 1e5; age_s *= 1.02) {
    double sum = 0.0;
    for (const DecayTerm& term : terms) {
      sum += term.weight_per_m * std::exp(-term.rate_per_s * age_s);
    }
    worst = std::max(worst, std::abs(sum * DepthAtAge_m(gas, age_s) - 1.0));
  }
  return worst;
}

TEST(AgeingDepthTest, DecaysAddUpToTheInverseDepth) {
  EXPECT_LT(WorstError(GasParameters()), 0.05);
  for (const double mixing_depth_m : {0.3, 1.0, 2.05, 6.0}) {
    for (const double diffusivity_m2_per_s : {0.0, 0.002, 0.02, 0.3}) {
      GasParameters gas;
      gas.mixing_depth_m = mixing_depth_m;
      gas.diffusivity_m2_per_s = diffusivity_m2_per_s;
      EXPECT_LT(WorstError(gas), 0.12) << mixing_depth_m << " m, K = " << diffusivity_m2_per_s;
    }
  }
}

TEST(AgeingDepthTest, ADepthThatDoesNotGrowIsOneTermThatNeverEnds) {
  GasParameters gas;
  gas.mixing_depth_m = 0.2;  // less than that of a fresh filament
  ASSERT_EQ(InverseDepthTerms(gas).size(), 1u);
  EXPECT_EQ(InverseDepthTerms(gas)[0].rate_per_s, 0.0);
  EXPECT_EQ(InverseDepthTerms(gas)[0].weight_per_m, 5.0);
  gas = GasParameters();
  gas.diffusivity_m2_per_s = gas.growth_m2_per_s = 0.0;
  ASSERT_EQ(InverseDepthTerms(gas).size(), 1u);
  EXPECT_NEAR(InverseDepthTerms(gas)[0].weight_per_m, 1.0 / (std::sqrt(2.0 * M_PI) * 0.1), 1e-9);
}

}  // namespace ageing_depth_test
}  // namespace plumescout::lab
