// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/types/rng.h"

namespace plumescout::lab {
namespace statistics_test {

TEST(Spread, IsThatOfAHandWorkedSample) {
  const std::vector<double> values = {2.0, 4.0, 4.0, 6.0};
  const Spread spread = SpreadOf(values);
  EXPECT_EQ(spread.count, 4u);
  EXPECT_DOUBLE_EQ(spread.mean, 4.0);
  EXPECT_DOUBLE_EQ(spread.stddev, std::sqrt(8.0 / 3.0));
  constexpr double kT3 = 3.182446;  // Student, 97.5 %, 3 degrees of freedom (tables)
  EXPECT_NEAR(spread.half_95, kT3 * std::sqrt(8.0 / 3.0) / 2.0, 1e-5);
}

TEST(Spread, OfOneValueIsNoneAndOfNoValuesHasNoMean) {
  EXPECT_EQ(SpreadOf(std::vector<double>{3.0}).half_95, 0.0);
  EXPECT_TRUE(std::isnan(SpreadOf({}).mean));
}

TEST(Spread, ItsIntervalHoldsTheTrueMeanInNinetyFivePercentOfSamples) {
  Rng rng(1);
  int held = 0;
  constexpr int kSamples = 2000;
  for (int k = 0; k < kSamples; ++k) {
    std::vector<double> values;
    for (int i = 0; i < 8; ++i) values.push_back(rng.Gaussian());
    const Spread spread = SpreadOf(values);
    held += std::abs(spread.mean) <= spread.half_95;
  }
  EXPECT_NEAR(held, 0.95 * kSamples, 4.0 * std::sqrt(0.95 * 0.05 * kSamples));
}

TEST(PairedRatio, IsTheGeometricMeanWithStudentsIntervalOfItsLogarithm) {
  // Ratios 2 and 8: mean sqrt(16); logarithms differ from ln 4 by ln 2 each way, so their standard
  // deviation is sqrt(2) ln 2 and that of the mean ln 2.
  const PairedRatio ratio = PairedRatioOf(std::vector{2.0, 4.0}, std::vector{1.0, 0.5});
  constexpr double kT1 = 12.7062;  // Student, 97.5 %, one degree of freedom (tables)
  EXPECT_DOUBLE_EQ(ratio.mean, 4.0);
  EXPECT_NEAR(ratio.low, 4.0 * std::exp(-kT1 * std::log(2.0)), 1e-5);
  EXPECT_NEAR(ratio.high * ratio.low, 16.0, 1e-9);
}

TEST(PairedRatio, OfOnePairHasNoInterval) {
  const PairedRatio one = PairedRatioOf(std::vector{3.0}, std::vector{2.0});
  EXPECT_DOUBLE_EQ(one.mean, 1.5);
  EXPECT_EQ(one.low, one.mean);
  EXPECT_EQ(one.high, one.mean);
  EXPECT_TRUE(std::isnan(PairedRatioOf({}, {}).mean));
}

// Of a mean it is as wide as Student's, but for the tails of 40 values' t: 2.02 in place of 1.96.
TEST(BootstrapInterval, OfAMeanIsThatOfTheMean) {
  Rng rng(11);
  std::vector<double> values;
  for (int i = 0; i < 40; ++i) values.push_back(rng.Gaussian());
  const Spread spread = SpreadOf(values);
  const Interval interval = BootstrapInterval(values.size(), [&](auto worlds) {
    double sum = 0.0;
    for (const std::size_t world : worlds) sum += values[world];
    return sum / static_cast<double>(worlds.size());
  });
  EXPECT_NEAR(interval.low, spread.mean - spread.half_95, 0.15 * spread.half_95);
  EXPECT_NEAR(interval.high, spread.mean + spread.half_95, 0.15 * spread.half_95);
}

TEST(BootstrapInterval, OfOneWorldIsItsFigure) {
  const Interval one = BootstrapInterval(1, [](auto) { return 3.0; });
  EXPECT_EQ(one.low, 3.0);
  EXPECT_EQ(one.high, 3.0);
  EXPECT_TRUE(std::isnan(BootstrapInterval(2, [](auto) { return std::nan(""); }).low));
}

TEST(Reduction, IsOfTheMeansWithAnIntervalOverPairs) {
  // Every pair is less by a tenth, however they are drawn.
  const Reduction even = ReductionOf(std::vector{9.0, 18.0}, std::vector{10.0, 20.0});
  EXPECT_NEAR(even.percent, 10.0, 1e-9);
  EXPECT_NEAR(even.low_95, 10.0, 1e-9);
  EXPECT_NEAR(even.high_95, 10.0, 1e-9);
  // A quarter of all draws takes the first pair twice (50 %), a quarter the second (0 %).
  const Reduction uneven = ReductionOf(std::vector{5.0, 10.0}, std::vector{10.0, 10.0});
  EXPECT_NEAR(uneven.percent, 25.0, 1e-9);
  EXPECT_NEAR(uneven.low_95, 0.0, 1e-9);
  EXPECT_NEAR(uneven.high_95, 50.0, 1e-9);
}

TEST(Reduction, OfANegativeBaselineIsOfItsSize) {
  EXPECT_NEAR(ReductionOf(std::vector{-12.0}, std::vector{-10.0}).percent, 20.0, 1e-9);
}

TEST(PairedPValue, CountsTheSwapsThatDoAsMuch) {
  // Differences 1, 2, 3: of the eight sign patterns only +++ and --- reach a sum of 6.
  EXPECT_DOUBLE_EQ(PairedPValue(std::vector{2.0, 4.0, 6.0}, std::vector{1.0, 2.0, 3.0}), 0.25);
  // Differences 1, -1: every pattern reaches a sum of 0.
  EXPECT_DOUBLE_EQ(PairedPValue(std::vector{1.0, 0.0}, std::vector{0.0, 1.0}), 1.0);
  EXPECT_DOUBLE_EQ(PairedPValue({}, {}), 1.0);
}

TEST(PairedPValue, DrawnSwapsAgreeWithAllOfThem) {
  Rng rng(3);
  std::vector<double> a;
  std::vector<double> b;
  for (int i = 0; i < 20; ++i) {
    a.push_back(rng.Gaussian() + 0.5);
    b.push_back(rng.Gaussian());
  }
  const double exact = PairedPValue(a, b);
  a.push_back(0.0);  // a pair without a difference makes it 21 and changes no sum
  b.push_back(0.0);
  EXPECT_NEAR(PairedPValue(a, b), exact, 4.0 * std::sqrt(exact / 1e6));
  EXPECT_GT(exact, 1e-4);
}

TEST(PairedPValue, IsBelowFivePercentAsOftenAsItSaysWithoutADifference) {
  Rng rng(5);
  int below = 0;
  constexpr int kStudies = 1000;
  for (int k = 0; k < kStudies; ++k) {
    std::vector<double> a;
    std::vector<double> b;
    for (int i = 0; i < 8; ++i) {
      a.push_back(rng.Gaussian());
      b.push_back(rng.Gaussian());
    }
    below += PairedPValue(a, b) <= 0.05;
  }
  EXPECT_NEAR(below, 0.05 * kStudies, 4.0 * std::sqrt(0.05 * 0.95 * kStudies));
}

TEST(WilsonInterval, IsThatOfThePublishedExample) {
  // 81 of 263 (Newcombe 1998, table I, method 3): 0.2553 to 0.3662.
  const ShareInterval interval = WilsonInterval(81, 263);
  EXPECT_NEAR(interval.low, 0.2553, 5e-5);
  EXPECT_NEAR(interval.high, 0.3662, 5e-5);
  EXPECT_NEAR(WilsonInterval(0, 10).low, 0.0, 1e-12);
}

TEST(WilsonInterval, IsWhatItsFormulaGivesByHand) {
  const ShareInterval interval = WilsonInterval(174, 250);
  // (0.696 + 3.8415/500 -+ 1.96 * 0.029355) / (1 + 3.8415/250)
  EXPECT_NEAR(interval.low, 0.6364, 5e-4);
  EXPECT_NEAR(interval.high, 0.7497, 5e-4);
  EXPECT_NEAR(WilsonInterval(0, 10).low, 0.0, 1e-12);
  EXPECT_NEAR(WilsonInterval(0, 10).high, 0.2775, 5e-4);
  EXPECT_NEAR(WilsonInterval(10, 10).high, 1.0, 1e-12);
}

}  // namespace statistics_test
}  // namespace plumescout::lab
