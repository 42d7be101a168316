// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/information_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/types/rng.h"
#include "tests/support/random_grid.h"

namespace plumescout {
namespace information_map_test {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::FloatEq;
using ::testing::FloatNear;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
// Single precision through some five operations on values of order 1.
constexpr float kRounding = 2e-6F;

// One row of cells; traversable unless told.
struct Row {
  std::vector<float> mean_ppm;
  std::vector<float> variance_ppm2;
  std::vector<std::uint8_t> traversable = std::vector<std::uint8_t>(mean_ppm.size(), 1);
};

template <typename T>
Grid<T> GridOf(const std::vector<T>& values) {
  Grid<T> grid(GridGeometry{0.0, 0.0, 0.1, static_cast<int>(values.size()), 1});
  grid.values() = values;
  return grid;
}

InformationMap InformationOf(const Row& row, const PlanningOptions& options = {}) {
  return MakeInformationMap({GridOf(row.traversable), GridOf(row.mean_ppm),
                             GridOf(row.variance_ppm2), PublishedGasOptions(), FrontierOptions{}},
                            options);
}

float EpsilonInf() { return static_cast<float>(OpenLatticeVariance_ppm2(PublishedGasOptions())); }

PlanningOptions WithBeta(double beta) {
  PlanningOptions options;
  options.beta = beta;
  return options;
}

TEST(InformationMap, FollowsEquations8To11OnRandomMaps) {
  Rng rng(3);
  for (int map = 0; map < 20; ++map) {
    const Grid<std::uint8_t> traversable = testing::RandomMask(13, 9, 0.7, rng);
    Grid<float> mean(traversable.geometry());
    Grid<float> variance(traversable.geometry());
    for (float& v : mean.values()) v = static_cast<float>(rng.Uniform(-2.0, 30.0));
    for (float& v : variance.values()) v = static_cast<float>(rng.Uniform(0.0, 0.4));
    const double beta = rng.Uniform(0.0, 2.0);
    const InformationMap information = MakeInformationMap(
        {traversable, mean, variance, PublishedGasOptions(), FrontierOptions{}}, WithBeta(beta));

    const double max_mean = *std::max_element(mean.values().begin(), mean.values().end());
    const double epsilon_inf = OpenLatticeVariance_ppm2(PublishedGasOptions());
    std::vector<double> bound;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const double mu = std::max(0.0, static_cast<double>(mean[i])) / std::max(max_mean, 2.0);
      bound.push_back(mu + beta * std::min(1.0, variance[i] / epsilon_inf));
    }
    double low = INFINITY;
    double high = -INFINITY;
    for (std::size_t i = 0; i < bound.size(); ++i) {
      if (traversable[i] == 0) continue;
      low = std::min(low, bound[i]);
      high = std::max(high, bound[i]);
    }
    for (std::size_t i = 0; i < bound.size(); ++i) {
      if (traversable[i] == 0) continue;
      const auto share = static_cast<float>((bound[i] - low) / (high - low));
      EXPECT_NEAR(information.value[i], share, 10 * kRounding);
      EXPECT_NEAR(information.penalty[i], std::max(1.0F - share, 1e-3F), 10 * kRounding);
    }
  }
}

TEST(InformationMap, IsInfinitelyDearWhereNotTraversable) {
  const InformationMap information =
      InformationOf({{0.0F, 5.0F, 9.0F}, {0.1F, 0.1F, 0.1F}, {1, 0, 1}});
  EXPECT_EQ(information.penalty[1], kInf);
  EXPECT_EQ(information.value[1], 0.0F);
}

TEST(InformationMap, NeverGetsCheaperThanTheFloor) {
  const InformationMap information = InformationOf({{0.0F, 50.0F}, {0.1F, 0.1F}});
  EXPECT_THAT(information.penalty.values(), ElementsAre(1.0F, kMinPenalty));
  EXPECT_EQ(information.min_penalty, kMinPenalty);
}

TEST(InformationMap, CountsMeansBelowZeroAsZero) {
  const InformationMap information = InformationOf({{-40.0F, 0.0F, 10.0F}, {0.1F, 0.1F, 0.1F}});
  EXPECT_EQ(information.value[0], information.value[1]);
}

TEST(InformationMap, MeasuresTheMeanAgainstAtLeastTheGasThreshold) {
  // Before any gas, 0.1 ppm of noise must not outweigh the variance: 0.1 / 2 against 1.
  const InformationMap information =
      InformationOf({{0.1F, 0.0F, 0.0F}, {0.0F, 0.5F * EpsilonInf(), EpsilonInf()}});
  EXPECT_NEAR(information.value[0], 0.0F, kRounding);
  EXPECT_NEAR(information.value[1], (0.5F - 0.05F) / 0.95F, kRounding);
}

TEST(InformationMap, NormalisesByTheGreatestMeanOfAllFreeCells) {
  // The cell with 20 ppm is free but inflated: it counts in Eq. (9), not in Eq. (10).
  const Row row{{20.0F, 10.0F, 0.0F}, {0.0F, 0.0F, EpsilonInf()}, {0, 1, 1}};
  const InformationMap information = InformationOf(row);
  EXPECT_THAT(information.value.values(), ElementsAre(0.0F, FloatNear(0.0F, kRounding), 1.0F));
}

TEST(InformationMap, TakesAtMostTheOpenLatticeVariance) {
  const InformationMap information =
      InformationOf({{0.0F, 0.0F, 0.0F}, {0.0F, EpsilonInf(), 100.0F * EpsilonInf()}});
  EXPECT_EQ(information.value[1], information.value[2]);
}

TEST(InformationMap, TakesTheRawVarianceIfTold) {
  PlanningOptions raw = WithBeta(0.5);
  raw.raw_variance = true;
  // I = mu~ + beta epsilon = 1 + 1, 0 + 4, 0 + 1 by Eq. (8) as printed.
  const InformationMap information = InformationOf({{8.0F, 0.0F, 0.0F}, {2.0F, 8.0F, 2.0F}}, raw);
  EXPECT_THAT(information.value.values(),
              ElementsAre(FloatNear(1.0F / 3.0F, kRounding), FloatEq(1.0F), FloatEq(0.0F)));
}

TEST(InformationMap, IsTheMeanAloneForBetaZero) {
  const InformationMap information =
      InformationOf({{0.0F, 4.0F, 8.0F}, {0.3F, 0.0F, 0.1F}}, WithBeta(0.0));
  EXPECT_THAT(information.value.values(), ElementsAre(0.0F, FloatEq(0.5F), 1.0F));
}

TEST(InformationMap, WithoutContrastIsFlatAndHalf) {
  const InformationMap information = InformationOf({{0.0F, 0.0F}, {0.2F, 0.2F}});
  EXPECT_TRUE(information.flat);
  EXPECT_THAT(information.value.values(), Each(0.5F));
  EXPECT_THAT(information.penalty.values(), Each(0.5F));
  EXPECT_EQ(information.min_penalty, 0.5F);
}

TEST(InformationMap, DoesNotMagnifyRoundingIntoContrast) {
  EXPECT_TRUE(InformationOf({{0.0F, 0.0F}, {0.2F, 0.2F * (1.0F + 3e-7F)}}).flat);
  EXPECT_FALSE(InformationOf({{0.0F, 0.0F}, {0.2F, 0.2F * (1.0F + 1e-3F)}}).flat);
}

TEST(InformationMap, TakesThePriorWhereGasIsNotComputedYet) {
  const InformationMap information =
      InformationOf({{0.0F, kNaN, 0.0F, kInf}, {0.0F, kNaN, EpsilonInf(), -kInf}});
  EXPECT_THAT(information.value.values(), ElementsAre(0.0F, 1.0F, 1.0F, 1.0F));
}

TEST(InformationMap, OfHugeValuesStaysInRange) {
  const InformationMap information = InformationOf({{3e38F, -3e38F, 0.0F}, {3e38F, 0.0F, 1.0F}});
  for (const float value : information.value.values()) {
    EXPECT_GE(value, 0.0F);
    EXPECT_LE(value, 1.0F);
  }
}

TEST(InformationMap, OfOneCellOrNoneIsFlat) {
  EXPECT_TRUE(InformationOf({{7.0F}, {0.1F}}).flat);
  EXPECT_TRUE(InformationOf({{7.0F, 1.0F}, {0.1F, 0.1F}, {0, 0}}).flat);
  EXPECT_TRUE(InformationOf({{}, {}}).flat);
}

}  // namespace information_map_test
}  // namespace plumescout
