// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/sampler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/plan/cost/hilbert.h"
#include "tests/support/plan_map.h"

namespace plumescout {
namespace sampler_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kFloatSum = 1e-5;  // single-precision masses, summed over some thousand cells

struct RandomCase {
  explicit RandomCase(std::uint64_t seed, int width = 40, int height = 30)
      : rng(seed),
        domain(testing::RandomObstacles(width, height, 8, rng)),
        information(testing::WavyInformation(domain, rng)),
        robot(testing::RandomOpenCell(domain, rng)) {}

  Rng rng;
  Grid<std::uint8_t> domain;
  InformationMap information;
  Cell robot;
};

double Total(const Grid<float>& mass) {
  return std::accumulate(mass.values().begin(), mass.values().end(), 0.0);
}

Grid<float> RowOfMass(std::vector<float> values) {
  Grid<float> mass(GridGeometry{0.0, 0.0, 0.1, static_cast<int>(values.size()), 1});
  mass.values() = std::move(values);
  return mass;
}

TEST(SamplingMass, FollowsEquation14) {
  const RandomCase c(1);
  const Grid<float> mass = SamplingMass(c.information, c.domain, c.robot, 0.2);
  double total = 0.0;
  double cells = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    if (c.domain[i] == 0 || c.domain.geometry().CellAtIndex(i) == c.robot) continue;
    total += c.information.value[i];
    cells += 1.0;
  }
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const bool counts = c.domain[i] != 0 && c.domain.geometry().CellAtIndex(i) != c.robot;
    const double q = 0.8 * c.information.value[i] / total + 0.2 / cells;
    EXPECT_NEAR(mass[i], counts ? q : 0.0, 1e-6 * q);
  }
  EXPECT_NEAR(Total(mass), 1.0, kFloatSum);
}

TEST(SamplingMass, IsUniformForAShareOfOneAndPureInformationForZero) {
  const RandomCase c(2);
  const Grid<float> uniform = SamplingMass(c.information, c.domain, c.robot, 1.0);
  std::set<float> values(uniform.values().begin(), uniform.values().end());
  EXPECT_EQ(values.size(), 2U);  // 0 and 1 / cells
  const Grid<float> pure = SamplingMass(c.information, c.domain, c.robot, 0.0);
  for (std::size_t i = 0; i < pure.size(); ++i) {
    if (c.information.value[i] == 0.0F) {
      EXPECT_EQ(pure[i], 0.0F);
    }
  }
}

TEST(SamplingMass, IsUniformIfAllInformationIsUnderTheRobot) {
  InformationMap information;
  information.value = RowOfMass({0.0F, 1.0F, 0.0F});
  Grid<std::uint8_t> domain(information.value.geometry(), 1);
  EXPECT_THAT(SamplingMass(information, domain, {1, 0}, 0.0).values(),
              ElementsAre(0.5F, 0.0F, 0.5F));
}

TEST(SamplingMass, OfTheRobotsCellAloneIsZero) {
  InformationMap information;
  information.value = RowOfMass({1.0F});
  EXPECT_EQ(Total(SamplingMass(information, Grid<std::uint8_t>(information.value.geometry(), 1),
                               {0, 0}, 0.2)),
            0.0);
}

TEST(DrawSamples, GivesDifferentCellsWithMassAsManyAsAsked) {
  RandomCase c(3);
  const Grid<float> mass = SamplingMass(c.information, c.domain, c.robot, 0.2);
  for (const SamplingKind kind : {SamplingKind::kIid, SamplingKind::kSystematic}) {
    for (const int count : {1, 7, 300, 600}) {
      const std::vector<Cell> samples = DrawSamples(mass, count, kind, c.rng);
      EXPECT_EQ(samples.size(), static_cast<std::size_t>(count));
      EXPECT_EQ(std::set<Cell>(samples.begin(), samples.end()).size(), samples.size());
      for (const Cell cell : samples) EXPECT_GT(mass[cell], 0.0F);
    }
  }
}

TEST(DrawSamples, GivesAllCellsIfThereAreNoMore) {
  Rng rng(4);
  const Grid<float> mass = RowOfMass({0.1F, 0.0F, 0.6F, 0.3F});
  for (const SamplingKind kind : {SamplingKind::kIid, SamplingKind::kSystematic}) {
    for (const int count : {3, 4, 1000}) {
      EXPECT_THAT(DrawSamples(mass, count, kind, rng),
                  ElementsAre(Cell{0, 0}, Cell{2, 0}, Cell{3, 0}));
    }
    EXPECT_THAT(DrawSamples(mass, 0, kind, rng), IsEmpty());
    EXPECT_THAT(DrawSamples(RowOfMass({0.0F, 0.0F}), 5, kind, rng), IsEmpty());
    EXPECT_THAT(DrawSamples(Grid<float>(), 5, kind, rng), IsEmpty());
  }
}

TEST(DrawSamples, IsRepeatableFromTheSeed) {
  const RandomCase c(5);
  const Grid<float> mass = SamplingMass(c.information, c.domain, c.robot, 0.2);
  for (const SamplingKind kind : {SamplingKind::kIid, SamplingKind::kSystematic}) {
    Rng first(77);
    Rng second(77);
    Rng third(78);
    const std::vector<Cell> samples = DrawSamples(mass, 100, kind, first);
    EXPECT_EQ(DrawSamples(mass, 100, kind, second), samples);
    EXPECT_NE(DrawSamples(mass, 100, kind, third), samples);
  }
}

// Pearson's statistic of single draws against the mass.
double ChiSquare(const Grid<float>& mass, SamplingKind kind, int draws) {
  Rng rng(6);
  std::map<Cell, int> counts;
  for (int i = 0; i < draws; ++i) ++counts[DrawSamples(mass, 1, kind, rng).at(0)];
  double statistic = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const double expected = draws * static_cast<double>(mass[i]);
    const double difference = counts[mass.geometry().CellAtIndex(i)] - expected;
    statistic += difference * difference / expected;
  }
  return statistic;
}

TEST(DrawSamples, SingleDrawsFollowTheMass) {
  const Grid<float> mass = RowOfMass({0.02F, 0.3F, 0.08F, 0.1F, 0.05F, 0.25F, 0.2F});
  // 6 degrees of freedom: a fair sampler exceeds 30.7 once in 35 000 seeds.
  EXPECT_LT(ChiSquare(mass, SamplingKind::kIid, 20'000), 30.7);
  EXPECT_LT(ChiSquare(mass, SamplingKind::kSystematic, 20'000), 30.7);
}

TEST(DrawSamples, IidPairsFollowDrawsWithoutReplacement) {
  const std::vector<double> q = {0.5, 0.3, 0.2};
  constexpr int kDraws = 20'000;
  Rng rng(7);
  int with_first = 0;
  for (int i = 0; i < kDraws; ++i) {
    const std::vector<Cell> pair =
        DrawSamples(RowOfMass({0.5F, 0.3F, 0.2F}), 2, SamplingKind::kIid, rng);
    if (pair[0] == Cell{0, 0}) ++with_first;
  }
  // P(cell 0 in the pair) = 1 - q1 q2 / (1 - q1) - q2 q1 / (1 - q2), within 5 standard deviations.
  const double p = 1.0 - q[1] * q[2] / (1.0 - q[1]) - q[2] * q[1] / (1.0 - q[2]);
  EXPECT_NEAR(with_first, kDraws * p, 5.0 * std::sqrt(kDraws * p * (1.0 - p)));
}

TEST(DrawSamples, SystematicGivesEveryRunOfTheCurveItsShareWithinOne) {
  RandomCase c(8);
  const Grid<float> mass = SamplingMass(c.information, c.domain, c.robot, 0.2);
  constexpr int kCount = 60;
  ASSERT_LT(*std::max_element(mass.values().begin(), mass.values().end()), 1.0F / kCount);
  for (int draw = 0; draw < 20; ++draw) {
    const std::vector<Cell> samples = DrawSamples(mass, kCount, SamplingKind::kSystematic, c.rng);
    const std::set<Cell> drawn(samples.begin(), samples.end());
    double expected = 0.0;
    int found = 0;
    ForEachCellAlongHilbert(mass.width(), mass.height(), [&](Cell cell) {
      expected += kCount * static_cast<double>(mass[cell]);
      found += static_cast<int>(drawn.count(cell));
      EXPECT_LT(std::abs(found - expected), 1.0 + kFloatSum * kCount);
    });
  }
}

TEST(DrawSamples, SystematicTakesHeavyCellsForCertainAndSharesTheRestByMass) {
  // Of 4 draws 0.7 would give the first cell 2.8: it is taken once. Of the 3 left and the mass 0.3
  // left 0.16 would give the second 1.6: taken. The others share 2 draws by 0.04 : 0.04 : 0.06.
  const Grid<float> mass = RowOfMass({0.7F, 0.04F, 0.16F, 0.04F, 0.06F});
  constexpr int kDraws = 20'000;
  Rng rng(9);
  std::map<int, int> counts;
  for (int i = 0; i < kDraws; ++i) {
    for (const Cell cell : DrawSamples(mass, 4, SamplingKind::kSystematic, rng)) ++counts[cell.x];
  }
  EXPECT_EQ(counts[0], kDraws);
  EXPECT_EQ(counts[2], kDraws);
  const double p = 2.0 * 0.04 / 0.14;
  const double five_sigma = 5.0 * std::sqrt(kDraws * p * (1.0 - p));
  EXPECT_NEAR(counts[1], kDraws * p, five_sigma);
  EXPECT_NEAR(counts[3], kDraws * p, five_sigma);
  EXPECT_NEAR(counts[4], kDraws * 2.0 * 0.06 / 0.14, five_sigma);
}

}  // namespace sampler_test
}  // namespace plumescout
