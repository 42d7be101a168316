// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/team_commit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace plumescout {
namespace team_commit_test {

using ::testing::HasSubstr;

Plan To(const RobotId& robot, double x_m) {
  Plan plan;
  plan.robot = robot;
  plan.candidates.resize(1);
  plan.candidates[0].goal.position = {x_m, 0.0};
  plan.chosen = 0;
  return plan;
}

TEST(CommitTeam, WhatIsRefusedOrToStayIsLeftOutAndTheOthersAreAssigned) {
  MissionConduct conduct(std::make_unique<Mission>(MissionOptions{}));
  for (const char* const robot : {"a", "b", "c"}) {
    ASSERT_TRUE(conduct.Register({robot, 0.2, 3}).ok());
  }
  TeamPlan team;
  team.plans = {To("a", 1.0), To("b", 1.0), To("c", 9.0), To("gone", 20.0)};
  team.plans[2].chosen = -1;
  team.plans[2].explanation = "Stay.";
  team.order_count = 2;
  const CommittedTeam committed = CommitTeam(team, conduct);
  EXPECT_EQ(committed.order_count, 2);
  ASSERT_EQ(committed.plans.size(), 1U);
  EXPECT_EQ(committed.plans[0].id, 1);
  EXPECT_EQ(conduct.Snapshot()->robots.at("a").assigned_plan, 1);
  ASSERT_EQ(committed.left_out.size(), 3U);
  EXPECT_THAT(committed.left_out[0].why, HasSubstr("claimed by robot \"a\""));
  EXPECT_EQ(committed.left_out[1].why, "Stay.");
  EXPECT_EQ(committed.left_out[2].robot, "gone");
}

}  // namespace team_commit_test
}  // namespace plumescout
