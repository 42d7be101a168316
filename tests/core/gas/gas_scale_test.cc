// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/types/rng.h"

namespace plumescout {
namespace gas_scale_test {

GasOptions Roots(double background_ppm = 0.0) {
  GasOptions gas;
  gas.scale = GasScale::kSquareRoot;
  gas.background_mean_ppm = background_ppm;
  return gas;
}

TEST(GasScaleTest, ALinearFieldIsInPpm) {
  GasOptions gas;
  gas.background_mean_ppm = 400.0;
  EXPECT_EQ(DeviationOnScale(gas, 450.0), 50.0);
  EXPECT_EQ(DeviationOnScale(gas, -1.0), -401.0);
  EXPECT_EQ(OffScale(gas, 50.0, 2.0).median_ppm, 450.0);
  EXPECT_EQ(OffScale(gas, 50.0, 2.0).variance_ppm2, 2.0);
}

TEST(GasScaleTest, RootsComeBack) {
  EXPECT_EQ(DeviationOnScale(Roots(4.0), 9.0), 1.0);
  EXPECT_EQ(OffScale(Roots(4.0), 1.0, 0.5).median_ppm, 9.0);
  EXPECT_EQ(DeviationOnScale(Roots(), -1.0), 0.0);
  // The root of no concentration is below 0.
  EXPECT_EQ(OffScale(Roots(4.0), -3.0, 0.5).median_ppm, 0.0);
}

TEST(GasScaleTest, TheVarianceIsThatOfTheSquare) {
  constexpr double kMean = 3.0;
  constexpr double kVariance = 0.7;
  Rng rng(1);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kDraws = 200'000;
  for (int i = 0; i < kDraws; ++i) {
    const double root = kMean + std::sqrt(kVariance) * rng.Gaussian();
    sum += root * root;
    squares += std::pow(root, 4);
  }
  const double mean = sum / kDraws;
  // 4 * 9 * 0.7 + 2 * 0.49 = 26.18; two hundred thousand draws tell it to about half a percent.
  EXPECT_DOUBLE_EQ(OffScale(Roots(), kMean, kVariance).variance_ppm2, 26.18);
  EXPECT_NEAR(squares / kDraws - mean * mean, 26.18, 0.6);
}

}  // namespace gas_scale_test
}  // namespace plumescout
