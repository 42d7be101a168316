// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/random_goals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/support/goal_case.h"

namespace plumescout {
namespace random_goals_test {

using testing::GoalCase;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// 3 x 3 cells around the robot, and a pocket that it cannot reach.
const testing::GridArt kRoom = {"#######",  //
                                "#...#.#",  //
                                "#.S.#.#",  //
                                "#...#.#",  //
                                "#######"};

TEST(RandomGoals, AreDifferentCellsThatCanBeReached) {
  GoalCase c(kRoom);
  c.options.max_goal_count = 5;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const std::vector<Goal> goals = RandomGoals(c.Query(), rng);
    std::set<Cell> cells;
    for (const Goal& goal : goals) {
      EXPECT_EQ(goal.kind, GoalKind::kRandomFreeSpace);
      EXPECT_NE(c.reachable[goal.cell], 0);
      EXPECT_NE(goal.cell, c.start);
      EXPECT_EQ(goal.position, c.belief.geometry().Center(goal.cell));
      EXPECT_EQ(goal.centroid, goal.position);
      cells.insert(goal.cell);
    }
    EXPECT_EQ(cells.size(), 5U);
  }
}

TEST(RandomGoals, AreAsManyAsThereAre) {
  GoalCase c(kRoom);
  c.options.max_goal_count = 100;
  Rng rng(1);
  EXPECT_THAT(RandomGoals(c.Query(), rng), SizeIs(8));
}

TEST(RandomGoals, KeepTheirDistance) {
  GoalCase c(kRoom);
  c.options.max_goal_count = 100;
  c.options.min_goal_distance_m = 0.12;  // the four diagonal neighbours are 0.14 m away
  Rng rng(1);
  EXPECT_THAT(RandomGoals(c.Query(), rng), SizeIs(4));
  c.options.min_goal_distance_m = 5.0;
  EXPECT_THAT(RandomGoals(c.Query(), rng), IsEmpty());
}

TEST(UnobservedGoals, LieAwayFromAllObservedCells) {
  const testing::GridArt art = {"########",  //
                                "#gg....#",  //
                                "#Sg....#",  //
                                "#gg....#",  //
                                "########"};
  GoalCase c(art);
  c.AddGas(art, 0.0F);
  c.options.max_goal_count = 100;
  Rng rng(1);
  std::set<int> columns;
  const std::vector<Goal> goals = UnobservedGoals(c.Query(), rng);
  for (const Goal& goal : goals) {
    columns.insert(goal.cell.x);
    EXPECT_EQ(goal.kind, GoalKind::kInformation);
  }
  EXPECT_EQ(columns, (std::set<int>{4, 5, 6})) << "column 3 touches observed cells";
  EXPECT_THAT(goals, SizeIs(9));
}

TEST(UnobservedGoals, AreNoneWhereAllIsObserved) {
  const testing::GridArt art = {"ggg",  //
                                "gSg"};
  GoalCase c(art);
  c.AddGas(art, 0.0F);
  Rng rng(1);
  EXPECT_THAT(UnobservedGoals(c.Query(), rng), IsEmpty());
}

TEST(RandomGoals, AreDrawnUniformly) {
  GoalCase c(kRoom);
  c.options.max_goal_count = 1;
  Rng rng(2);
  std::map<Cell, int> counts;
  constexpr int kDraws = 8000;
  for (int i = 0; i < kDraws; ++i) ++counts[RandomGoals(c.Query(), rng).at(0).cell];
  EXPECT_EQ(counts.size(), 8U);
  for (const auto& [cell, count] : counts) EXPECT_NEAR(count, 1000, 5 * 30);  // 5 sigma
}

TEST(RandomGoals, AvoidThePlacesOfOtherRobots) {
  GoalCase c(kRoom);
  Goal claimed;
  claimed.kind = GoalKind::kRandomFreeSpace;
  claimed.position = c.belief.geometry().Center(c.start);  // the whole room is within 0.5 m
  c.belief.claims = {{"other", 1, claimed, 1000}};
  Rng rng(3);
  EXPECT_THAT(RandomGoals(c.Query(), rng), IsEmpty());
}

}  // namespace random_goals_test
}  // namespace plumescout
