// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/ageing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout {
namespace ageing_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

GasOptions HalfLife(double half_life_s) {
  GasOptions options = PublishedGasOptions();
  options.ageing_half_life_s = half_life_s;
  return options;
}

TEST(AgeingTest, FollowsTheFormula) {
  const GasOptions options = HalfLife(60.0);
  const Ageing ageing(options);
  const double lambda_o = options.observation_precision_per_ppm2;
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
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2({7.0, 4.0}), 4.0);
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2({7.0, 0.0}), 0.1);
}

TEST(AgeingTest, NoiseGrowsWithTheReadingFromWhereItExceedsTheFloor) {
  GasOptions options = HalfLife(0.0);
  options.observation_precision_per_ppm2 = 4.0;  // sigma_min = 0.5 ppm
  options.observation_stddev_share = 0.1;
  const Ageing ageing(options);
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2({0.0, 0.0}), 0.25);
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2({4.9, 0.0}), 0.25);
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2({6.0, 0.0}), 0.36);
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2({200.0, 0.0}), 400.0);
}

TEST(AgeingTest, NoiseGrowsWithTheDistanceFromTheBackgroundOnEitherSide) {
  GasOptions options = HalfLife(0.0);
  options.background_mean_ppm = 400.0;
  options.observation_stddev_share = 0.1;
  const Ageing ageing(options);
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2({400.0, 0.0}), 0.1);
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2({600.0, 0.0}), 400.0);
  EXPECT_DOUBLE_EQ(ageing.InitialVariance_ppm2({390.0, 0.0}), 1.0);
}

TEST(AgeingTest, AReadingsOwnVarianceComesBeforeTheRelativeOne) {
  GasOptions options = HalfLife(0.0);
  options.observation_stddev_share = 10.0;
  EXPECT_DOUBLE_EQ(Ageing(options).InitialVariance_ppm2({1000.0, 2.0}), 2.0);
}

TEST(AgeingTest, RelativeNoiseOfTheWidestReadingsStaysFinite) {
  GasOptions options = HalfLife(0.0);
  options.observation_stddev_share = 10.0;
  for (const double reading_ppm : {-1e300, 1e9, 1e300}) {
    const double variance_ppm2 = Ageing(options).InitialVariance_ppm2({reading_ppm, 0.0});
    EXPECT_TRUE(std::isfinite(variance_ppm2 * variance_ppm2)) << reading_ppm;
  }
}

TEST(AgeingTest, BoundsThePrecisionOfAReading) {
  const Ageing ageing(HalfLife(0.0));
  const double variance_ppm2 =
      ageing.InitialVariance_ppm2({1.0, std::numeric_limits<double>::denorm_min()});
  EXPECT_LE(ageing.Precision(variance_ppm2, 0, 0), 1e9 * (1.0 + 1e-12));
}

TEST(AgeingTest, LetsAHugeVarianceSayNothingWithoutOverflow) {
  const Ageing ageing(HalfLife(1.0));
  const double variance_ppm2 =
      ageing.InitialVariance_ppm2({1.0, std::numeric_limits<double>::max()});
  EXPECT_TRUE(std::isfinite(variance_ppm2 * variance_ppm2));
  EXPECT_LT(ageing.Precision(variance_ppm2, 0, 0), 1e-9 * 1e-16);  // of the least background's
}

}  // namespace ageing_test
}  // namespace plumescout
