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
