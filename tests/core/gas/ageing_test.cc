// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/ageing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

GasOptions HalfLife(double half_life_s) {
  GasOptions options;
  options.ageing_half_life_s = half_life_s;
  return options;
}

TEST(AgeingTest, FollowsTheFormula) {
  const GasOptions options = HalfLife(60.0);
  const Ageing ageing(options);
  const double lambda_o = options.observation_precision;
  const double lambda_t = 60.0 * lambda_o;
  for (const std::int64_t age_s : {0, 1, 30, 60, 600, 86400}) {
    EXPECT_DOUBLE_EQ(ageing.Precision(1.0 / lambda_o, 5 * kSecond_ns, (5 + age_s) * kSecond_ns),
                     1.0 / (1.0 / lambda_o + static_cast<double>(age_s) / lambda_t));
  }
}

TEST(AgeingTest, HalvesThePrecisionInAHalfLife) {
  const Ageing ageing(HalfLife(60.0));
  EXPECT_DOUBLE_EQ(ageing.Precision(0.1, 0, 60 * kSecond_ns), 5.0);
}

TEST(AgeingTest, KnowsWhetherPrecisionHasHalved) {
  const Ageing ageing(HalfLife(60.0));
  EXPECT_FALSE(ageing.IsHalved(0, 59 * kSecond_ns));
  EXPECT_TRUE(ageing.IsHalved(0, 61 * kSecond_ns));
  EXPECT_FALSE(ageing.IsHalved(61 * kSecond_ns, 0));
  EXPECT_FALSE(Ageing(HalfLife(0.0)).IsHalved(0, std::numeric_limits<std::int64_t>::max()));
}

TEST(AgeingTest, KeepsPrecisionForEverWithoutAHalfLife) {
  const Ageing ageing(HalfLife(0.0));
  EXPECT_FALSE(ageing.enabled());
  EXPECT_DOUBLE_EQ(ageing.Precision(0.1, 0, std::numeric_limits<std::int64_t>::max()), 10.0);
}

TEST(AgeingTest, TreatsAReadingFromTheFutureAsNew) {
  const Ageing ageing(HalfLife(60.0));
  EXPECT_DOUBLE_EQ(ageing.Precision(0.1, 100 * kSecond_ns, 0), 10.0);
}

TEST(AgeingTest, SurvivesTheWidestClocks) {
  const Ageing ageing(HalfLife(1.0));
  const double precision = ageing.Precision(0.1, std::numeric_limits<std::int64_t>::min(),
                                            std::numeric_limits<std::int64_t>::max());
  EXPECT_GT(precision, 0.0);
  EXPECT_LT(precision, 1e-8);  // 584 years
}

TEST(AgeingTest, UsesTheVarianceThatAReadingBrings) {
  const Ageing ageing(HalfLife(60.0));
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2(4.0), 4.0);
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2(0.0), 0.1);
}

TEST(AgeingTest, BoundsThePrecisionOfAReading) {
  const Ageing ageing(HalfLife(0.0));
  const double variance_ppm2 =
      ageing.InitialVariance_ppm2(std::numeric_limits<double>::denorm_min());
  EXPECT_LE(ageing.Precision(variance_ppm2, 0, 0), 1e9 * (1.0 + 1e-12));
}

TEST(AgeingTest, LetsAHugeVarianceSayNothingWithoutOverflow) {
  const Ageing ageing(HalfLife(1.0));
  const double variance_ppm2 = ageing.InitialVariance_ppm2(std::numeric_limits<double>::max());
  EXPECT_TRUE(std::isfinite(variance_ppm2 * variance_ppm2));
  EXPECT_LT(ageing.Precision(variance_ppm2, 0, 0), 1e-9 * 1e-16);  // of the least background's
}

}  // namespace
}  // namespace plumescout
