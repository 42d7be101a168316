// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/team/team_belief.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/traffic/traffic.h"
#include "tests/support/corridor_team.h"

namespace plumescout {
namespace team_belief_test {

using testing::CorridorTeam;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Plan East(const RobotId& robot, GoalKind kind = GoalKind::kInformation) {
  Plan plan;
  plan.robot = robot;
  plan.chosen = 0;
  plan.candidates.resize(1);
  const Point2 goal = CorridorTeam::At(9.0);
  plan.candidates[0].goal = {kind, {90, 4}, goal, goal, 0};
  plan.trajectory = TimeTrajectory({CorridorTeam::At(1.0), goal}, 0.0, PlanningOptions());
  return plan;
}

TEST(TeamBelief, APlanIsLiveAndClaimsItsGoal) {
  CorridorTeam team;
  team.Stands("a", 1.0);
  const Belief with = WithPlan(team.belief, East("a"));
  EXPECT_TRUE(IsOnItsWay(with.robots.at("a"), with.sample_time_ns));
  EXPECT_NEAR(Lateness_s(with.robots.at("a"), with.sample_time_ns), 0.0, 1e-6);
  ASSERT_THAT(with.claims, SizeIs(1));
  EXPECT_EQ(with.claims[0].goal, East("a").candidates[0].goal);
  EXPECT_EQ(with.traversable, team.belief.traversable) << "rasters are shared";
  EXPECT_THAT(WithPlan(team.belief, East("a", GoalKind::kHome)).claims, IsEmpty());
  Plan stay;
  stay.robot = "a";
  const Belief again = WithPlan(with, stay);
  EXPECT_EQ(again.robots.at("a").live_trajectory, nullptr);
  EXPECT_THAT(again.claims, IsEmpty());
}

TEST(TeamBelief, PlansThatAreEndedClaimNothing) {
  CorridorTeam team;
  team.Stands("a", 1.0);
  const Belief without = WithoutPlans(WithPlan(team.belief, East("a")), {"a", "unknown"});
  EXPECT_EQ(without.robots.at("a").live_trajectory, nullptr);
  EXPECT_FALSE(without.robots.at("a").live_goal.has_value());
  EXPECT_THAT(without.claims, IsEmpty());
}

TEST(TeamBelief, FreeIsWhoIsHereAndFollowsNoPlan) {
  CorridorTeam team;
  for (const char* const robot : {"d", "a", "b", "c", "e"}) team.Stands(robot, 1.0);
  team.Drives("b", 5.0);
  team.belief.robots["c"].state.silent = true;
  team.belief.robots["e"].state.has_pose = false;
  EXPECT_THAT(FreeRobots(team.belief), ElementsAre("a", "d"));
}

}  // namespace team_belief_test
}  // namespace plumescout
