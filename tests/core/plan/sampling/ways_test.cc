// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/ways.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/grid/flood.h"
#include "core/grid/grid_search.h"
#include "tests/support/plan_map.h"

namespace plumescout {
namespace ways_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::MaskFromArt;
using ::testing::SizeIs;

constexpr double kRounding = 1e-9;

const testing::GridArt kWall = {".......",  //
                                "...#...",  //
                                "...#...",  //
                                "...#..."};

double Length_m(const std::vector<Point2>& vertices) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    length_m += Distance_m(vertices[i - 1], vertices[i]);
  }
  return length_m;
}

TEST(WaysFrom, DrivesStraightWhereNothingIsInBetween) {
  const Grid<std::uint8_t> open = MaskFromArt(kWall);
  const std::vector<Way> ways = WaysFrom(open, {0.03, 0.05}, {{0.05, 0.35}, {0.25, 0.05}});
  ASSERT_THAT(ways, SizeIs(2));
  EXPECT_THAT(ways[0].vertices, ElementsAre(Point2{0.03, 0.05}, Point2{0.05, 0.35}));
  EXPECT_NEAR(ways[0].length_m, std::hypot(0.02, 0.3), kRounding);
  EXPECT_NEAR(ways[1].length_m, 0.22, kRounding);
}

TEST(WaysFrom, GoesRoundWhatIsInBetween) {
  const Grid<std::uint8_t> open = MaskFromArt(kWall);
  const Point2 from = open.geometry().Center({0, 0});
  const Point2 to = open.geometry().Center({6, 0});
  const Way way = WaysFrom(open, from, {to}).at(0);
  ASSERT_GE(way.vertices.size(), 3u);
  EXPECT_EQ(way.vertices.front(), from);
  EXPECT_EQ(way.vertices.back(), to);
  EXPECT_NEAR(way.length_m, Length_m(way.vertices), kRounding);
  EXPECT_GT(way.length_m, 0.6);
  for (std::size_t i = 1; i < way.vertices.size(); ++i) {
    EXPECT_TRUE(IsClear(open, way.vertices[i - 1], way.vertices[i]));
  }
}

TEST(WaysFrom, IsEmptyWhereThereIsNoWay) {
  const Grid<std::uint8_t> open = MaskFromArt({"..#.", "..#."});
  const std::vector<Way> ways = WaysFrom(open, {0.05, 0.05}, {{0.35, 0.05}, {0.05, 0.15}});
  ASSERT_THAT(ways, SizeIs(2));
  EXPECT_THAT(ways[0].vertices, IsEmpty());
  EXPECT_THAT(ways[1].vertices, SizeIs(2));
}

TEST(WaysFrom, StaysWhereItIs) {
  const Grid<std::uint8_t> open = MaskFromArt(kWall);
  const Way way = WaysFrom(open, {0.05, 0.05}, {{0.05, 0.05}}).at(0);
  ASSERT_FALSE(way.vertices.empty());
  EXPECT_EQ(way.vertices.back(), (Point2{0.05, 0.05}));
  EXPECT_EQ(way.length_m, 0.0);
}

TEST(WaysFrom, NothingIsAskedForNothing) {
  EXPECT_THAT(WaysFrom(MaskFromArt(kWall), {0.05, 0.05}, {}), IsEmpty());
}

// Against the distance on the grid, and looked at every hundredth of a cell.
TEST(WaysFrom, AreClearAndNoLongerThanOnTheGridAmongRandomObstacles) {
  Rng rng(20);
  for (int map = 0; map < 20; ++map) {
    const Grid<std::uint8_t> open = testing::RandomObstacles(40, 30, 25, rng);
    const Cell start = testing::RandomOpenCell(open, rng);
    const Grid<std::uint8_t> reachable = ReachableCells(open, {start});
    Grid<float> price(open.geometry(), std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i] != 0) price[i] = 1.0F;
    }
    const Grid<double> travel_m = TravelDistances_m(open, std::vector<Cell>{start});
    std::vector<Cell> cells;
    std::vector<Point2> places;
    for (int i = 0; i < 10; ++i) {
      cells.push_back(testing::RandomOpenCell(reachable, rng));
      places.push_back(open.geometry().Center(cells.back()));
    }
    const Point2 from = open.geometry().Center(start);
    const std::vector<Way> ways = WaysFrom(open, from, places);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      ASSERT_GE(ways[i].vertices.size(), 2u);
      EXPECT_EQ(ways[i].vertices.back(), places[i]);
      EXPECT_LE(ways[i].length_m, travel_m[cells[i]] + kRounding);
      EXPECT_GE(ways[i].length_m, Distance_m(from, places[i]) - kRounding);
      EXPECT_TRUE(testing::StaysClear(price, ways[i].vertices));
    }
  }
}

}  // namespace ways_test
}  // namespace plumescout
