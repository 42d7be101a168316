// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/relevance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/gas/noise_scale.h"
#include "core/types/rng.h"
#include "tests/support/measured_hall.h"

namespace plumescout {
namespace relevance_test {

constexpr double kSingle = 1e-6;  // relative error of a handful of operations in single precision

Grid<float> Means(const std::vector<float>& means_ppm) {
  Grid<float> grid(GridGeometry{0.0, 0.0, 0.1, static_cast<int>(means_ppm.size()), 1});
  grid.values() = means_ppm;
  return grid;
}

TEST(Relevance, IsThatOfTheFormula) {
  Rng rng(5);
  std::vector<float> means_ppm;
  double greatest_ppm = 0.0;
  for (int i = 0; i < 200; ++i) {
    means_ppm.push_back(static_cast<float>(rng.Uniform(-5.0, 30.0)));
    greatest_ppm = std::max(greatest_ppm, static_cast<double>(means_ppm.back()));
  }
  const std::vector<float> relevance = Relevance(Means(means_ppm), MissionOptions());
  ASSERT_EQ(relevance.size(), means_ppm.size());
  for (std::size_t i = 0; i < relevance.size(); ++i) {
    const double c = std::max(0.0, static_cast<double>(means_ppm[i]));
    const double s = c / 4.0;  // twice the least threshold, 2 ppm
    const double expected = 0.05 + 0.95 * std::pow(std::min(1.0, s), 2) + 0.5 * c / greatest_ppm;
    EXPECT_NEAR(static_cast<double>(relevance[i]), expected, 4.0 * kSingle);
  }
}

TEST(Relevance, CountsFromTheBackgroundToTheFixedThreshold) {
  MissionOptions options;
  options.gas.background_mean_ppm = 400.0;
  options.frontier.fixed_gas_threshold_ppm = 500.0;
  const auto relevance = Relevance(Means({0.0F, 400.0F, 450.0F, 500.0F, 600.0F}), options);
  EXPECT_EQ(relevance[0], kCleanRelevance) << "less than the background";
  EXPECT_EQ(relevance[1], kCleanRelevance);
  EXPECT_NEAR(relevance[2], 0.05 + 0.95 * 0.25 + 0.5 * 0.25, kSingle);
  EXPECT_NEAR(relevance[3], 0.05 + 0.95 + 0.5 * 0.5, kSingle);
  EXPECT_NEAR(relevance[4], 1.5, kSingle);
}

TEST(Relevance, TakesTheLeastThresholdIfTheFixedOneIsNotAboveTheBackground) {
  MissionOptions options;
  options.gas.background_mean_ppm = 400.0;
  options.frontier.fixed_gas_threshold_ppm = 400.0;
  const auto relevance = Relevance(Means({402.0F, 408.0F}), options);
  EXPECT_NEAR(relevance[0], 0.05 + 0.95 * 0.25 + 0.5 * 0.25, kSingle);
  EXPECT_NEAR(relevance[1], 1.5, kSingle);
}

TEST(Relevance, OfFaintGasAloneIsNotMadeGreatByItsBeingTheGreatest) {
  const auto relevance = Relevance(Means({0.0F, 0.4F}), MissionOptions());
  EXPECT_NEAR(relevance[1], 0.05 + 0.95 * 0.01 + 0.5 * 0.1, kSingle);
}

TEST(Relevance, WhereTheMeanIsNotKnownIsThatOfCleanAir) {
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  const auto relevance = Relevance(Means({unknown, 10.0F, unknown}), MissionOptions());
  EXPECT_EQ(relevance[0], kCleanRelevance);
  EXPECT_NEAR(relevance[1], 1.5, kSingle);
  EXPECT_EQ(relevance[2], kCleanRelevance);
  EXPECT_EQ(Relevance(Means({unknown}), MissionOptions())[0], kCleanRelevance);
  EXPECT_TRUE(Relevance(Grid<float>(), MissionOptions()).empty());
}

TEST(Relevance, NeverFallsWithTheMeanAndStaysWithinItsBounds) {
  std::vector<float> means_ppm;
  for (int i = -50; i < 400; ++i) means_ppm.push_back(0.25F * static_cast<float>(i));
  means_ppm.push_back(1e6F);
  const auto relevance = Relevance(Means(means_ppm), MissionOptions());
  for (std::size_t i = 0; i < relevance.size(); ++i) {
    EXPECT_GE(relevance[i], i == 0 ? kCleanRelevance : relevance[i - 1]);
    EXPECT_LE(relevance[i], 1.5F * (1.0F + static_cast<float>(kSingle)));
  }
}

TEST(Relevance, WhatIsDecidedHasNone) {
  support::MeasuredHall hall(support::Objective(ObjectiveKind::kConfirmClean, 0.0));
  hall.Set({5, 5}, 9.0F, 1.0F);
  hall.Forget({7, 7});
  const GridGeometry& geometry = hall.belief.geometry();
  Belief whole = hall.belief;
  MissionOptions options = *hall.belief.options;
  options.objective = support::Objective(ObjectiveKind::kCompleteMap);
  whole.options = std::make_shared<const MissionOptions>(options);
  const std::vector<float> all = Relevance(whole);
  const std::vector<float> relevance = Relevance(hall.belief);
  for (std::size_t i = 0; i < relevance.size(); ++i) {
    const Cell cell = geometry.CellAtIndex(i);
    const bool is_free = hall.occupancy->At(cell, CellState::kUnknown) == CellState::kFree;
    const bool undecided = cell == Cell{5, 5} || cell == Cell{7, 7} || !is_free;
    EXPECT_EQ(relevance[i], undecided ? all[i] : 0.0F) << cell.x << ", " << cell.y;
  }
}

TEST(Relevance, OfACompleteMapIsThatOfItsMeansWhereVariancesDoNotKnowTheLevel) {
  support::MeasuredHall hall(support::Objective(ObjectiveKind::kCompleteMap),
                             GasScale::kSquareRoot);
  hall.Set({5, 5}, 9.0F, 1.0F);
  EXPECT_EQ(Relevance(hall.belief), Relevance(*hall.belief.gas_mean_ppm, *hall.belief.options));
}

TEST(Relevance, ElseItIsThatOfTheRootOfTheVarianceByLevelMore) {
  support::MeasuredHall hall(support::Objective(ObjectiveKind::kCompleteMap));
  hall.belief.gas_quality.clean_air_scale = 10.0;  // twice that of LevelScale
  hall.Set({5, 5}, 9.0F, 1.0F);
  hall.Set({6, 5}, 1.0F, 4.0F);
  hall.Set({7, 5}, 9.0F, 100.0F);
  const std::vector<float> relevance = Relevance(hall.belief);
  const GridGeometry& geometry = hall.belief.geometry();
  const auto at = [&](Cell cell) { return relevance[geometry.Index(cell)]; };
  // The greatest mean is 9 ppm, and gas is sure from 4 ppm on. The model's variance is 0.01 ppm^2.
  EXPECT_NEAR(at({5, 5}), 1.0 + 0.5, kSingle);
  const double bound = 1.0 + std::sqrt(2.0 * LevelScale(GasOptions(), 1.0) * 0.01);
  EXPECT_NEAR(at({6, 5}), 0.05 + 0.95 * bound * bound / 16.0 + 0.5 * bound / 9.0, 4.0 * kSingle);
  EXPECT_NEAR(at({7, 5}), 1.5, kSingle) << "never above its bound, whatever variance is published";
  EXPECT_EQ(Relevance(hall.belief, {{6, 5}, {7, 6}}), std::vector<float>(1, at({6, 5})));
}

}  // namespace relevance_test
}  // namespace plumescout
