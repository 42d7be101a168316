// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/conduct/team_commit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/support/box_room.h"

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

TEST(CommitTeam, PlansThatAreReplacedKeepNobodyFromTheirGoals) {
  MissionConduct conduct(std::make_unique<Mission>(MissionOptions{}));
  for (const char* const robot : {"a", "b", "c"}) {
    ASSERT_TRUE(conduct.Register({robot, 0.2, 3}).ok());
  }
  ASSERT_TRUE(conduct.Commit(To("a", 1.0), 3).ok());
  ASSERT_TRUE(conduct.Commit(To("b", 9.0), 3).ok());
  ASSERT_TRUE(conduct.Commit(To("c", 20.0), 3).ok());
  TeamPlan team;
  team.plans = {To("a", 9.0), To("b", 20.0), To("c", 1.0)};
  team.plans[2].chosen = -1;
  team.plans[2].explanation = "Stay.";
  const CommittedTeam committed = CommitTeam(team, conduct);
  ASSERT_EQ(committed.plans.size(), 2U);
  EXPECT_EQ(committed.plans[0].robot, "a");
  EXPECT_EQ(committed.plans[1].robot, "b");
  ASSERT_EQ(committed.left_out.size(), 1U);
  EXPECT_EQ(committed.left_out[0].robot, "c");
  const auto belief = conduct.Snapshot();
  EXPECT_EQ(belief->robots.at("a").live_goal->position, (Point2{9.0, 0.0}));
  EXPECT_EQ(belief->robots.at("b").live_goal->position, (Point2{20.0, 0.0}));
  EXPECT_EQ(belief->robots.at("c").live_trajectory, nullptr) << "it was planned to stay";
  EXPECT_EQ(belief->robots.at("c").assigned_plan, belief->robots.at("c").last_plan);
}

TEST(CommitTeam, WhoseSearchFailedGoesOnWithThePlanThatItHas) {
  MissionConduct conduct(std::make_unique<Mission>(MissionOptions{}));
  for (const char* const robot : {"a", "b"}) {
    ASSERT_TRUE(conduct.Register({robot, 0.2, 3}).ok());
  }
  ASSERT_TRUE(conduct.Commit(To("b", 9.0), 3).ok());
  TeamPlan team;
  team.plans = {To("a", 9.0)};
  team.left_out = {{"b", "it has no pose"}};
  const CommittedTeam committed = CommitTeam(team, conduct);
  EXPECT_TRUE(committed.plans.empty());
  ASSERT_EQ(committed.left_out.size(), 2U);
  EXPECT_EQ(committed.left_out[0], (LeftOut{"b", "it has no pose"}));
  EXPECT_THAT(committed.left_out[1].why, HasSubstr("claimed by robot \"b\""));
  EXPECT_EQ(conduct.Snapshot()->robots.at("b").last_plan, 1);
}

// "c", which is not of the team, goes to 1 m.
void CommitForAll(MissionConduct& conduct) {
  for (const char* const robot : {"a", "b", "c"}) {
    ASSERT_TRUE(conduct.Register({robot, 0.2, 3}).ok());
  }
  ASSERT_TRUE(conduct.Commit(To("c", 1.0), 3).ok());
  ASSERT_TRUE(conduct.Commit(To("a", 9.0), 3).ok());
}

TEST(CommitTeam, WhoseNewPlanIsRefusedGoesOnWithTheOneThatItHas) {
  MissionConduct conduct(std::make_unique<Mission>(MissionOptions{}));
  CommitForAll(conduct);
  TeamPlan team;
  team.plans = {To("b", 20.0), To("a", 1.0)};
  const CommittedTeam committed = CommitTeam(team, conduct);
  EXPECT_EQ(committed.plans.size(), 1U);
  ASSERT_EQ(committed.left_out.size(), 1U);
  EXPECT_THAT(committed.left_out[0].why, HasSubstr("claimed by robot \"c\""));
  const auto belief = conduct.Snapshot();
  EXPECT_EQ(belief->robots.at("a").last_plan, 2);
  EXPECT_NE(belief->robots.at("a").live_trajectory, nullptr);
}

TEST(CommitTeam, WhoIsStoppedForAnotherWantsNothingThatItsSearchRejected) {
  MissionConduct conduct(std::make_unique<Mission>(MissionOptions{}));
  CommitForAll(conduct);
  TeamPlan team;
  team.plans = {To("b", 9.0), To("a", 1.0)};
  team.plans[1].rejected = {{Goal{}, RejectionReason::kTraffic, ""}};
  const CommittedTeam committed = CommitTeam(team, conduct);
  ASSERT_EQ(committed.plans.size(), 1U);
  EXPECT_EQ(committed.plans[0].robot, "b");
  const auto belief = conduct.Snapshot();
  EXPECT_EQ(belief->robots.at("a").live_trajectory, nullptr);
  EXPECT_FALSE(belief->robots.at("a").wanted_goal.has_value());
}

TEST(CommitTeam, NobodyIsStoppedForAPlanThatIsRefusedAllTheSame) {
  MissionConduct conduct(std::make_unique<Mission>(MissionOptions{}));
  CommitForAll(conduct);
  TeamPlan team;
  // "b" would go to less than a claim's radius from the goals of both.
  ASSERT_TRUE(conduct.Commit(To("a", 1.7), 3).ok());
  team.plans = {To("b", 1.4), To("a", 30.0)};
  team.plans[1].chosen = 1;  // of one: no mission takes it
  const CommittedTeam committed = CommitTeam(team, conduct);
  EXPECT_TRUE(committed.plans.empty());
  EXPECT_EQ(committed.left_out.size(), 2U);
  EXPECT_EQ(conduct.Snapshot()->robots.at("a").last_plan, 3);
}

TEST(CommitTeam, NobodyIsStoppedForAWayThatWasClosed) {
  MissionConduct conduct(std::make_unique<Mission>(MissionOptions{}));
  CommitForAll(conduct);
  const Pose2 pose{5.0, 2.0, 0.0};
  IncomingObservation scan;
  scan.observation = {1, 1'000'000'000, pose, support::ScanInBox(pose, 10.0, 4.0)};
  ASSERT_TRUE(conduct.Ingest("c", 3, {scan}).status.ok());
  TeamPlan team;
  team.plans = {To("b", 9.0), To("a", 1.0)};  // "a" goes where "b" would; "c" is where "a" would
  team.plans[0].trajectory.waypoints = {{{0.0, 0.0, 0.0}, 0.0}, {{9.0, 0.0, 0.0}, 7.2}};
  KeepOutChanged change;
  change.added = {{{{4.0, -1.0}, {5.0, -1.0}, {5.0, 1.0}, {4.0, 1.0}}, "closed"}};
  ASSERT_TRUE(conduct.ChangeKeepOut(change).ok());
  const CommittedTeam committed = CommitTeam(team, conduct);
  EXPECT_TRUE(committed.plans.empty());
  EXPECT_NE(conduct.Snapshot()->robots.at("a").live_trajectory, nullptr);
}

}  // namespace team_commit_test
}  // namespace plumescout
