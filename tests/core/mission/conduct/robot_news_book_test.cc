// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/robot_news_book.h"

#include <gtest/gtest.h>

#include "core/mission/mission.h"

namespace plumescout {
namespace robot_news_book_test {

class RobotNewsBookTest : public ::testing::Test {
 protected:
  RobotNewsBookTest() : belief_(*Mission(MissionOptions{}).Snapshot()) {
    belief_.robots["r1"].last_plan = 3;
  }

  Belief belief_;
  RobotNewsBook book_;
};

TEST_F(RobotNewsBookTest, LooksAreDueAtOnceAndThenPeriodically) {
  EXPECT_EQ(book_.next_look_ns(), 0);
  book_.NoteLook(7);
  EXPECT_EQ(book_.next_look_ns(), 500'000'007);
}

TEST_F(RobotNewsBookTest, RobotsStandAsTheBeliefSays) {
  EXPECT_EQ(book_.StandingOf("r1"), RobotStanding());
  belief_.robots["r1"].state.ordered_home = true;
  belief_.robots["r1"].state.silent = true;
  book_.Follow(belief_);
  EXPECT_EQ(book_.StandingOf("r1"), (RobotStanding{.ordered_home = true, .silent = true}));
  belief_.robots.clear();
  book_.Follow(belief_);
  EXPECT_EQ(book_.StandingOf("r1"), RobotStanding());
}

TEST_F(RobotNewsBookTest, WhatIsNotedOfAPlanIsKnownUntilTheRobotHasAnother) {
  book_.Note("r1", PlanInvalidated{.plan = 3});
  book_.Note("r1", PlanAssigned{3});
  book_.Note("r1", RobotStanding{.silent = true});
  book_.Follow(belief_);
  EXPECT_EQ(book_.PlanNewsOf("r1").invalidated, PlanInvalidated{.plan = 3});
  EXPECT_EQ(book_.PlanNewsOf("r1").assigned, PlanAssigned{3});
  EXPECT_FALSE(book_.StandingOf("r1").silent) << "that is the belief's to say";
  EXPECT_EQ(book_.PlanNewsOf("r2").assigned, std::nullopt);

  belief_.robots["r1"].last_plan = 4;
  book_.Note("r1", PlanAssigned{4});
  book_.Follow(belief_);
  EXPECT_EQ(book_.PlanNewsOf("r1").invalidated, std::nullopt);
  EXPECT_EQ(book_.PlanNewsOf("r1").assigned, PlanAssigned{4});
}

TEST_F(RobotNewsBookTest, WhoHasLeftIsForgotten) {
  book_.Follow(belief_);
  book_.Note("r1", PlanAssigned{3});
  const RobotRecord record = belief_.robots["r1"];
  belief_.robots.clear();
  book_.Follow(belief_);
  belief_.robots["r1"] = record;
  book_.Follow(belief_);
  EXPECT_EQ(book_.PlanNewsOf("r1").assigned, std::nullopt);
}

}  // namespace robot_news_book_test
}  // namespace plumescout
