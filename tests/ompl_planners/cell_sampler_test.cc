// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/cell_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/plan_map.h"

namespace plumescout {
namespace cell_sampler_test {

constexpr GridGeometry kGeometry = {-1.3, 2.7, 0.1, 30, 20};

TEST(CellSampler, DrawsEveryMarkedCellAboutEquallyOftenAndNoOther) {
  Rng rng(5);
  const Grid<std::uint8_t> domain = testing::RandomObstacles(30, 20, 12, rng);
  const CellSampler sampler(domain);
  constexpr int kDrawsPerCell = 100;
  Grid<int> draws(domain.geometry(), 0);
  for (std::size_t i = 0; i < kDrawsPerCell * sampler.size(); ++i) {
    ++draws[domain.geometry().CellAt(sampler.Draw(rng))];
  }
  // Poisson with mean 100: beyond six standard deviations once in a thousand million cells.
  constexpr int kSixDeviations = 60;
  for (std::size_t i = 0; i < domain.size(); ++i) {
    if (domain[i] == 0) {
      EXPECT_EQ(draws[i], 0);
    } else {
      EXPECT_NEAR(draws[i], kDrawsPerCell, kSixDeviations);
    }
  }
}

TEST(CellSampler, SpreadsDrawsOverTheCell) {
  Grid<std::uint8_t> domain(kGeometry, 0);
  domain[Cell{7, 9}] = 1;
  const CellSampler sampler(domain);
  const Point2 center = kGeometry.Center({7, 9});
  Rng rng(1);
  double sum_x_m = 0.0;
  double squares_m2 = 0.0;
  constexpr int kDraws = 3000;
  for (int i = 0; i < kDraws; ++i) {
    const Point2 p = sampler.Draw(rng);
    EXPECT_LE(std::abs(p.x_m - center.x_m), 0.05);
    EXPECT_LE(std::abs(p.y_m - center.y_m), 0.05);
    sum_x_m += p.x_m - center.x_m;
    squares_m2 += (p.x_m - center.x_m) * (p.x_m - center.x_m);
  }
  const double variance_m2 = 0.1 * 0.1 / 12.0;  // of the uniform distribution
  EXPECT_NEAR(sum_x_m / kDraws, 0.0, 6.0 * std::sqrt(variance_m2 / kDraws));
  EXPECT_NEAR(squares_m2 / kDraws, variance_m2, 0.15 * variance_m2);
}

TEST(CellSampler, ConfinedDropsOnlyCellsThatNoShortWayTouches) {
  const Grid<std::uint8_t> domain(kGeometry, 1);
  const Point2 a = kGeometry.Center({5, 5});
  const Point2 b = kGeometry.Center({20, 12});
  const double length_m = 1.2 * Distance_m(a, b);
  CellSampler sampler(domain);
  sampler.Confine(a, b, length_m);
  Grid<std::uint8_t> drawn(kGeometry, 0);
  Rng rng(3);
  for (std::size_t i = 0; i < 100 * sampler.size(); ++i) {
    const Point2 p = sampler.Draw(rng);
    drawn[kGeometry.CellAt(p)] = 1;
    // No farther outside than a cell's diagonal on each leg.
    EXPECT_LE(Distance_m(a, p) + Distance_m(p, b), length_m + 4.0 * 0.0708);
  }
  for (std::size_t i = 0; i < domain.size(); ++i) {
    const Point2 center = kGeometry.Center(kGeometry.CellAtIndex(i));
    if (Distance_m(a, center) + Distance_m(center, b) <= length_m) {
      EXPECT_EQ(drawn[i], 1);
    }
  }
  EXPECT_LT(sampler.size(), domain.size() / 2);
}

TEST(CellSampler, OfNothingIsEmpty) {
  EXPECT_TRUE(CellSampler(Grid<std::uint8_t>(kGeometry, 0)).empty());
  EXPECT_TRUE(CellSampler(Grid<std::uint8_t>()).empty());
  CellSampler sampler(Grid<std::uint8_t>(kGeometry, 1));
  sampler.Confine(kGeometry.Center({0, 0}), kGeometry.Center({29, 19}), 0.1);
  EXPECT_TRUE(sampler.empty());
}

}  // namespace cell_sampler_test
}  // namespace plumescout
