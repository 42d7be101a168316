// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/edge_prices.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/path_case.h"

namespace plumescout {
namespace edge_prices_test {

using testing::PathCase;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Point2 RandomCenter(const PathCase& c, Rng& rng) {
  const GridGeometry& geometry = c.open.geometry();
  return geometry.Center(geometry.CellAtIndex(rng.Below(geometry.size())));
}

// Few places, so that edges come again, with other limits.
TEST(EdgePrices, AreThoseOfTheCostWhateverWasAskedBefore) {
  constexpr int kPlaces = 12;
  constexpr int kAsks = 20'000;
  for (const CostKind kind : {CostKind::kUcb, CostKind::kVertices, CostKind::kEuclidean}) {
    const PathCase c(3, {}, kind);
    EdgePrices prices(c.cost);
    Rng rng(5);
    std::vector<Point2> places;
    for (int i = 0; i < kPlaces; ++i) places.push_back(RandomCenter(c, rng));
    int cheaper = 0;
    for (int i = 0; i < kAsks; ++i) {
      const Point2 a = places[rng.Below(kPlaces)];
      const Point2 b = places[rng.Below(kPlaces)];
      const double price = c.cost(a, b);
      const double limit = rng.Uniform(0.0, 2.0) * (price < kInfinity ? price : 10.0);
      const double told = prices.UpTo(a, b, limit);
      if (price < limit) {
        EXPECT_EQ(told, price);
        ++cheaper;
      } else {
        EXPECT_GE(told, limit);
        EXPECT_TRUE(told == price || told == kInfinity);
      }
    }
    EXPECT_GT(cheaper, kAsks / 50);
  }
}

TEST(EdgePrices, TellsAnEdgeFromItsReverse) {
  const PathCase c(3, {}, CostKind::kVertices);
  EdgePrices prices(c.cost);
  const Point2 a = c.start;
  const Point2 b = {c.start.x_m + 0.1, c.start.y_m};
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(prices.UpTo(a, b, kInfinity), c.cost(a, b));
    EXPECT_EQ(prices.UpTo(b, a, kInfinity), c.cost(b, a));
  }
}

// Of no memory yet, whose places hold the origin.
TEST(EdgePrices, KnowsNothingOfTheOriginAtFirst) {
  const PathCase c(3);
  EdgePrices prices(c.cost);
  EXPECT_EQ(prices.UpTo({}, {}, kInfinity), c.cost({}, {}));
  EXPECT_EQ(prices.UpTo({}, {}, -kInfinity) < 0.0, false);
}

}  // namespace edge_prices_test
}  // namespace plumescout
