// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/team_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/grid_art.h"

namespace plumescout::lab {
namespace team_rules_test {

using ::testing::ElementsAre;
using testing::GridFromArt;
using ::testing::IsEmpty;

constexpr double kNoWay_m = std::numeric_limits<double>::infinity();

// 12 m by 3 m; cells of 1 m, the wall is one of them.
const Grid<CellState> kOpen = GridFromArt({"............", "............", "............"}, 1.0);
const Grid<CellState> kWalled = GridFromArt({"......#.....", "......#.....", "......#....."}, 1.0);

TEST(BurgardValues, UntakenFrontiersAreWorthOneLessTheWay) {
  EXPECT_THAT(BurgardValues({{1.5, 1.5}, {9.5, 1.5}}, {2.0, 8.0}, {}, kOpen, {}),
              ElementsAre(1.0 - 2.0 / 8.0, 1.0 - 8.0 / 8.0));
}

TEST(BurgardValues, WhatIsSeenFromATakenOneIsWorthLess) {
  // 2 m apart of a range of 8: 1 - 2/8 is taken off; 10 m apart nothing is.
  EXPECT_THAT(BurgardValues({{1.5, 1.5}, {11.5, 1.5}}, {0.0, 0.0}, {{1.5, 1.5}}, kOpen, {}),
              ElementsAre(0.0, 1.0));
  EXPECT_THAT(BurgardValues({{3.5, 1.5}}, {0.0}, {{1.5, 1.5}}, kOpen, {}), ElementsAre(0.25));
  // Two that see it take off both.
  EXPECT_THAT(BurgardValues({{3.5, 1.5}}, {0.0}, {{1.5, 1.5}, {7.5, 1.5}}, kOpen, {}),
              ElementsAre(1.0 - 0.75 - 0.5));
}

TEST(BurgardValues, WallsHideWhatIsBehind) {
  EXPECT_THAT(BurgardValues({{8.5, 1.5}}, {0.0}, {{4.5, 1.5}}, kOpen, {}), ElementsAre(0.5));
  EXPECT_THAT(BurgardValues({{8.5, 1.5}}, {0.0}, {{4.5, 1.5}}, kWalled, {}), ElementsAre(1.0));
}

TEST(BurgardValues, BetaWeighsWays) {
  EXPECT_THAT(BurgardValues({{1.5, 1.5}}, {4.0}, {}, kOpen, {.range_m = 8.0, .beta = 3.0}),
              ElementsAre(1.0 - 3.0 * 0.5));
}

// Cells of 1 m whose centres are at half metres: within 1 m of one centre are it and its four
// neighbours. East of x = 6 m nothing is known.
const Grid<CellState> kHalf = GridFromArt({"......??????", "......??????", "......??????"}, 1.0);

TEST(RrtRevenues, AreUnknownAreaLessTheStraightWay) {
  // At (6.5, 1.5): unknown are it, north, south and east: 4 m^2. At (8.5, 1.5): all five.
  EXPECT_THAT(RrtRevenues({1.5, 1.5}, {{6.5, 1.5}, {8.5, 1.5}}, {}, kHalf, {}),
              ElementsAre(3.0 * 4.0 - 5.0, 3.0 * 5.0 - 7.0));
}

TEST(RrtRevenues, WhatIsNearCountsTwice) {
  EXPECT_THAT(RrtRevenues({3.5, 1.5}, {{6.5, 1.5}}, {}, kHalf, {}),
              ElementsAre(3.0 * 2.0 * 4.0 - 3.0));
  EXPECT_THAT(RrtRevenues({3.0, 1.5}, {{6.5, 1.5}}, {}, kHalf, {}), ElementsAre(3.0 * 4.0 - 3.5));
}

TEST(RrtRevenues, WhatATakenOneSeesTooCountsForNothing) {
  // (8.5, 1.5) has 5 cells; those of (7.5, 1.5) are that one, its north, south, (6.5) and (8.5):
  // shared are (7.5, 1.5) and (8.5, 1.5).
  EXPECT_THAT(RrtRevenues({1.5, 1.5}, {{8.5, 1.5}}, {{7.5, 1.5}}, kHalf, {}),
              ElementsAre(3.0 * 3.0 - 7.0));
  EXPECT_THAT(RrtRevenues({1.5, 1.5}, {{8.5, 1.5}}, {{8.5, 1.5}}, kHalf, {}), ElementsAre(-7.0));
}

TEST(RrtRevenues, BeyondTheMapThereIsNothing) {
  // At the east edge: it, north, south and west.
  EXPECT_THAT(RrtRevenues({1.5, 1.5}, {{11.5, 1.5}}, {}, kHalf, {}), ElementsAre(3.0 * 4.0 - 10.0));
}

TEST(MatchGoals, AllWaysTogetherAreShortest) {
  EXPECT_THAT(MatchGoals({}), IsEmpty());
  EXPECT_THAT(MatchGoals({{1.0, 3.0}, {2.0, 10.0}}), ElementsAre(1u, 0u));
}

TEST(MatchGoals, GoalsAreHandedOutAgainToMoreRobots) {
  // Each goal goes to two at most: the third that would take the first goes to the second.
  EXPECT_THAT(MatchGoals({{1.0, 5.0}, {1.0, 9.0}, {1.0, 9.0}}), ElementsAre(1u, 0u, 0u));
  EXPECT_THAT(MatchGoals({{1.0}, {2.0}}), ElementsAre(0u, 0u));
}

TEST(MatchGoals, NobodyGoesWhereItCannot) {
  EXPECT_THAT(MatchGoals({{1.0, kNoWay_m}, {1.0, 1000.0}}), ElementsAre(0u, 1u));
}

}  // namespace team_rules_test
}  // namespace plumescout::lab
