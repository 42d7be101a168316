// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/search_meter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/path_case.h"

namespace plumescout {
namespace search_meter_test {

using testing::PathCase;

constexpr PathCase::Shape kEmptyRoom = {20, 20, 0, 1};

// The i-th of some edges that are all different.
Point2 End(const PathCase& c, int i) { return c.open.geometry().Center({i, 3}); }

TEST(SearchMeter, PricesLikeTheProblem) {
  const PathCase c(1);
  const PathProblem problem = c.Problem();
  SearchMeter meter(problem);
  for (const Goal& goal : c.goals) {
    EXPECT_EQ(meter.Price(c.start, goal.position), c.cost(c.start, goal.position));
  }
  EXPECT_EQ(meter.edges(), 4);
}

TEST(SearchMeter, CountsAnEdgeAskedTwiceInARowOnce) {
  const PathCase c(1, kEmptyRoom);
  const PathProblem problem = c.Problem();
  SearchMeter meter(problem);
  const double price = meter.Price(End(c, 1), End(c, 5));
  EXPECT_EQ(meter.Price(End(c, 1), End(c, 5)), price);
  EXPECT_EQ(meter.Price(End(c, 5), End(c, 1)), price);
  EXPECT_EQ(meter.edges(), 1);
  meter.Price(End(c, 1), End(c, 6));
  meter.Price(End(c, 1), End(c, 5));
  EXPECT_EQ(meter.edges(), 3);
}

TEST(SearchMeter, BlocksNewEdgesOnceTheBudgetIsSpent) {
  const PathCase c(1, kEmptyRoom);
  const PathProblem problem = c.Problem(1, 2);
  SearchMeter meter(problem);
  meter.Begin(10, 1);
  EXPECT_FALSE(meter.Over());
  EXPECT_TRUE(std::isfinite(meter.Price(c.start, End(c, 1))));
  EXPECT_TRUE(std::isfinite(meter.Price(c.start, End(c, 2))));
  EXPECT_TRUE(std::isfinite(meter.Price(c.start, End(c, 2))));  // known
  EXPECT_TRUE(meter.Over());
  EXPECT_FALSE(std::isfinite(meter.Price(c.start, End(c, 3))));
  EXPECT_EQ(meter.edges(), 2);
  EXPECT_TRUE(meter.cut_short());
  EXPECT_FALSE(meter.stopped());
}

TEST(SearchMeter, SharesWhatIsLeftAmongTheSearchesLeft) {
  const PathCase c(1, kEmptyRoom);
  const PathProblem problem = c.Problem(1, 9);
  SearchMeter meter(problem);
  int x = 0;
  for (const int share : {3, 3, 3}) {
    meter.Begin(1000, static_cast<std::size_t>(3 - x / 3));
    for (int i = 0; i < share; ++i) {
      EXPECT_FALSE(meter.Over());
      meter.Price(c.start, End(c, ++x));
    }
    EXPECT_TRUE(meter.Over());
  }
  EXPECT_EQ(meter.edges(), 9);
}

TEST(SearchMeter, EndsASearchAfterItsDrawsAndNotTheNextOne) {
  const PathCase c(1, kEmptyRoom);
  const PathProblem problem = c.Problem();
  SearchMeter meter(problem);
  meter.Begin(2, 2);
  meter.CountDraw();
  EXPECT_FALSE(meter.Over());
  meter.CountDraw();
  EXPECT_TRUE(meter.Over());
  EXPECT_FALSE(meter.cut_short());
  meter.Begin(1, 1);
  EXPECT_FALSE(meter.Over());
  EXPECT_EQ(meter.draws(), 2);
}

TEST(SearchMeter, StaysStoppedOnceTheStopFunctionSaidSo) {
  PathCase c(1, kEmptyRoom);
  int polls = 0;
  c.stop = [&polls] { return ++polls == 2; };
  const PathProblem problem = c.Problem();
  SearchMeter meter(problem);
  meter.Begin(10, 1);
  EXPECT_FALSE(meter.Over());
  EXPECT_TRUE(meter.Over());
  meter.Begin(10, 1);
  EXPECT_TRUE(meter.Over());
  EXPECT_TRUE(meter.stopped());
}

}  // namespace search_meter_test
}  // namespace plumescout
