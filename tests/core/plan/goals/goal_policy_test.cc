// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/goal_policy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace plumescout {
namespace goal_policy_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Goals told apart by their number of cells: gas 1, 2, ..., occupancy 101, 102, ... The higher the
// number the nearer.
std::vector<OfferedGoal> Offered(int count, int first_number) {
  std::vector<OfferedGoal> goals;
  for (int i = 0; i < count; ++i) {
    OfferedGoal offered;
    offered.goal.frontier_cells = first_number + i;
    offered.travel_m = 100.0 - i;
    goals.push_back(offered);
  }
  return goals;
}

struct Chosen {
  std::vector<int> numbers;
  std::vector<RejectedGoal> rejected;
};

Chosen Choose(int gas, int occupancy, GoalPolicy policy, bool draw_goals, std::uint64_t seed = 1) {
  PlanningOptions options;
  options.goal_policy = policy;
  options.draw_goals = draw_goals;
  options.max_goal_count = 3;
  FrontierGoals frontiers;
  frontiers.gas = Offered(gas, 1);
  frontiers.occupancy = Offered(occupancy, 101);
  Rng rng(seed);
  Chosen chosen;
  for (const Goal& goal : ChooseByPolicy(frontiers, options, rng, chosen.rejected)) {
    chosen.numbers.push_back(goal.frontier_cells);
  }
  return chosen;
}

TEST(ChooseByPolicy, DrawingFillsTheSlotsWithTheFirstKindThenTheSecond) {
  const Chosen gas_first = Choose(2, 4, GoalPolicy::kGasFirst, true);
  ASSERT_THAT(gas_first.numbers, SizeIs(3));
  EXPECT_EQ(std::set<int>(gas_first.numbers.begin(), gas_first.numbers.begin() + 2),
            (std::set<int>{1, 2}));
  EXPECT_GT(gas_first.numbers[2], 100);
  const Chosen occupancy_first = Choose(2, 4, GoalPolicy::kOccupancyFirst, true);
  ASSERT_THAT(occupancy_first.numbers, SizeIs(3));
  for (const int number : occupancy_first.numbers) EXPECT_GT(number, 100);
}

TEST(ChooseByPolicy, DrawingIsFairWithinAKind) {
  std::map<int, int> counts;
  constexpr int kDraws = 6000;
  for (int seed = 1; seed <= kDraws; ++seed) {
    for (const int number :
         Choose(5, 0, GoalPolicy::kGasFirst, true, static_cast<std::uint64_t>(seed)).numbers) {
      ++counts[number];
    }
  }
  // Each with probability 3/5; five standard deviations.
  for (int number = 1; number <= 5; ++number) EXPECT_NEAR(counts[number], 3600, 5 * 38);
}

TEST(ChooseByPolicy, DrawingIsRepeatableFromTheSeed) {
  EXPECT_EQ(Choose(9, 9, GoalPolicy::kGasFirst, true, 4).numbers,
            Choose(9, 9, GoalPolicy::kGasFirst, true, 4).numbers);
}

TEST(ChooseByPolicy, NotDrawingTakesAllOfTheFirstKind) {
  const Chosen chosen = Choose(5, 2, GoalPolicy::kGasFirst, false);
  EXPECT_THAT(chosen.numbers, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(chosen.rejected, SizeIs(2));
}

TEST(ChooseByPolicy, NotDrawingFillsFreeSlotsWithTheNearestOfTheSecondKind) {
  EXPECT_THAT(Choose(1, 4, GoalPolicy::kGasFirst, false).numbers, ElementsAre(1, 104, 103));
  EXPECT_THAT(Choose(4, 1, GoalPolicy::kOccupancyFirst, false).numbers, ElementsAre(101, 4, 3));
}

TEST(ChooseByPolicy, NotDrawingTakesAllOfTheSecondKindIfThereIsNoneOfTheFirst) {
  EXPECT_THAT(Choose(0, 5, GoalPolicy::kGasFirst, false).numbers,
              ElementsAre(105, 104, 103, 102, 101));
}

TEST(ChooseByPolicy, SaysWhichGoalsWereNotDrawn) {
  for (const bool draw_goals : {true, false}) {
    const Chosen chosen = Choose(2, 4, GoalPolicy::kGasFirst, draw_goals);
    EXPECT_THAT(chosen.rejected, SizeIs(3));
    for (const RejectedGoal& goal : chosen.rejected) {
      EXPECT_EQ(goal.reason, RejectionReason::kNotDrawn);
      EXPECT_GT(goal.goal.frontier_cells, 100);
    }
  }
}

TEST(ChooseByPolicy, EverythingIsTheNearestOfEachKind) {
  const Chosen chosen = Choose(5, 4, GoalPolicy::kEverything, false);
  EXPECT_THAT(chosen.numbers, ElementsAre(5, 4, 3, 104, 103, 102));
  std::set<int> not_drawn;
  for (const RejectedGoal& goal : chosen.rejected) {
    EXPECT_EQ(goal.reason, RejectionReason::kNotDrawn);
    not_drawn.insert(goal.goal.frontier_cells);
  }
  EXPECT_EQ(not_drawn, (std::set<int>{1, 2, 101}));
}

TEST(ChooseByPolicy, EverythingGivesNoSlotOfOneKindToTheOther) {
  EXPECT_THAT(Choose(1, 5, GoalPolicy::kEverything, false).numbers, ElementsAre(1, 105, 104, 103));
  EXPECT_THAT(Choose(0, 5, GoalPolicy::kEverything, false).numbers, ElementsAre(105, 104, 103));
  EXPECT_THAT(Choose(5, 0, GoalPolicy::kEverything, false).numbers, ElementsAre(5, 4, 3));
}

TEST(ChooseByPolicy, EverythingDrawsWithinEachKindIfToldSo) {
  std::map<int, int> counts;
  constexpr int kDraws = 2000;
  for (int seed = 1; seed <= kDraws; ++seed) {
    const Chosen chosen =
        Choose(5, 4, GoalPolicy::kEverything, true, static_cast<std::uint64_t>(seed));
    ASSERT_THAT(chosen.numbers, SizeIs(6));
    for (const int number : chosen.numbers) ++counts[number];
  }
  // With probability 3/5 and 3/4; five standard deviations.
  for (int number = 1; number <= 5; ++number) EXPECT_NEAR(counts[number], 1200, 5 * 22);
  for (int number = 101; number <= 104; ++number) EXPECT_NEAR(counts[number], 1500, 5 * 20);
}

TEST(ChooseByPolicy, OfNothingIsNothing) {
  EXPECT_THAT(Choose(0, 0, GoalPolicy::kGasFirst, true).numbers, IsEmpty());
  EXPECT_THAT(Choose(0, 0, GoalPolicy::kOccupancyOnly, false).numbers, IsEmpty());
  EXPECT_THAT(Choose(0, 0, GoalPolicy::kEverything, false).numbers, IsEmpty());
}

}  // namespace goal_policy_test
}  // namespace plumescout
