// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/frontier_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/strategy_case.h"

namespace plumescout {
namespace frontier_list_test {

using ::testing::IsEmpty;
using ::testing::SizeIs;

// A frontier of three cells in the east, one of a single cell in the west.
const testing::GridArt kHall = {"##########",  //
                                "#........?",  //
                                "?..S.....?",  //
                                "#........?",  //
                                "##########"};

std::vector<JudgedFrontier> List(const Belief& belief) {
  const auto listed = ListFrontiers(belief, "r", {});
  EXPECT_TRUE(listed.ok()) << listed.status();
  return listed.value_or(std::vector<JudgedFrontier>{});
}

const JudgedFrontier& OfSize(const std::vector<JudgedFrontier>& frontiers, int cells) {
  for (const JudgedFrontier& frontier : frontiers) {
    if (frontier.goal.frontier_cells == cells) return frontier;
  }
  ADD_FAILURE() << "none has " << cells << " cells";
  return frontiers.front();
}

TEST(ListFrontiers, HoldsOfferedAndRejectedOnes) {
  const auto frontiers = List(testing::SmallBelief(kHall));
  ASSERT_THAT(frontiers, SizeIs(2));
  const JudgedFrontier& east = OfSize(frontiers, 3);
  EXPECT_FALSE(east.rejection.has_value());
  EXPECT_NEAR(east.travel_m.value_or(0.0), 0.5, 1e-6);
  const JudgedFrontier& west = OfSize(frontiers, 1);
  ASSERT_TRUE(west.rejection.has_value());
  EXPECT_EQ(west.rejection->reason, RejectionReason::kTooSmall);
  EXPECT_NEAR(west.travel_m.value_or(0.0), 0.2, 1e-6);
}

TEST(ListFrontiers, AgreesWithWhatAPlanSays) {
  const Belief belief = testing::SmallBelief(testing::kRoom);
  const auto frontiers = List(belief);
  const auto plan = testing::TryPlan(belief, testing::For("r"));
  ASSERT_TRUE(plan.ok()) << plan.status();
  ASSERT_THAT(plan->candidates, Not(IsEmpty()));
  for (const Candidate& candidate : plan->candidates) {
    EXPECT_TRUE(std::any_of(frontiers.begin(), frontiers.end(), [&](const auto& frontier) {
      return frontier.goal == candidate.goal && !frontier.rejection;
    }));
  }
  for (const RejectedGoal& rejected : plan->rejected) {
    EXPECT_TRUE(std::any_of(frontiers.begin(), frontiers.end(),
                            [&](const auto& frontier) { return frontier.rejection == rejected; }));
  }
}

TEST(ListFrontiers, NoneIsReachableWithoutAWayOut) {
  const auto frontiers = List(testing::SmallBelief({"######",  //
                                                    "#S#..?",  //
                                                    "###..?",  //
                                                    "#.#..?",  //
                                                    "######"}));
  for (const JudgedFrontier& frontier : frontiers) {
    EXPECT_FALSE(frontier.travel_m.has_value());
    EXPECT_TRUE(frontier.rejection.has_value());
  }
}

TEST(ListFrontiers, StartsOutsideTheInflatedZone) {
  const auto frontiers = List(testing::SmallBelief({"######",  //
                                                    "#Si..?",  //
                                                    "#ii..?",  //
                                                    "#ii..?",  //
                                                    "######"}));
  ASSERT_THAT(frontiers, SizeIs(1));
  EXPECT_TRUE(frontiers[0].travel_m.has_value());
}

TEST(ListFrontiers, NeedsARobotWithAPlaceOnTheMap) {
  Belief belief = testing::SmallBelief(kHall);
  EXPECT_EQ(ListFrontiers(belief, "stranger", {}).status().code(), absl::StatusCode::kNotFound);
  belief.robots["r"].state.pose.x_m = 500.0;
  EXPECT_EQ(ListFrontiers(belief, "r", {}).status().code(), absl::StatusCode::kFailedPrecondition);
  belief.robots["r"].state.has_pose = false;
  EXPECT_EQ(ListFrontiers(belief, "r", {}).status().code(), absl::StatusCode::kFailedPrecondition);
}

}  // namespace frontier_list_test
}  // namespace plumescout
