// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/team/assigned_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "tests/support/corridor_team.h"

namespace plumescout {
namespace assigned_plan_test {

using testing::CorridorTeam;

CorridorTeam Assigned() {
  CorridorTeam team;
  team.Stands("a", 1.0);
  team.Drives("a", 9.0);
  team.belief.robots["a"].assigned_plan = 7;
  return team;
}

PlanRequest For(const RobotId& robot) {
  PlanRequest request;
  request.robot = robot;
  return request;
}

TEST(AssignedPlan, IsTheLiveOneAsTheBeliefKnowsIt) {
  const CorridorTeam team = Assigned();
  const std::optional<Plan> plan = AssignedPlan(team.belief, For("a"));
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->id, 7);
  EXPECT_EQ(plan->chosen, 0);
  EXPECT_EQ(plan->phase, MissionPhase::kReturning);
  EXPECT_EQ(plan->trajectory, *team.belief.robots.at("a").live_trajectory);
  EXPECT_EQ(plan->candidates.at(0).path.back(), CorridorTeam::At(9.0));
  EXPECT_EQ(AssignedPlan(team.belief, For("a")), plan) << "asked again, it is the same";
}

TEST(AssignedPlan, WhoAskedItselfOrIsElsewhereOrWantsHomePlansAnew) {
  CorridorTeam team = Assigned();
  PlanRequest request = For("a");
  request.start = Pose2{1.6, CorridorTeam::kMiddle_m, 0.0};
  EXPECT_FALSE(AssignedPlan(team.belief, request).has_value());
  request.start = Pose2{1.4, CorridorTeam::kMiddle_m, 0.0};
  EXPECT_TRUE(AssignedPlan(team.belief, request).has_value());
  request.go_home = true;
  EXPECT_TRUE(AssignedPlan(team.belief, request).has_value());
  team.belief.robots["a"].live_goal->kind = GoalKind::kInformation;
  EXPECT_FALSE(AssignedPlan(team.belief, request).has_value());
  team.Stands("a", 3.0);
  EXPECT_FALSE(AssignedPlan(team.belief, For("a")).has_value()) << "it has driven on";
  team.Stands("a", 1.0);
  team.belief.robots["a"].assigned_plan = 0;
  EXPECT_FALSE(AssignedPlan(team.belief, For("a")).has_value());
  EXPECT_FALSE(AssignedPlan(team.belief, For("z")).has_value());
}

TEST(AssignedPlan, WhatNobodyReckonsWithAnyMoreIsPlannedAnew) {
  CorridorTeam team = Assigned();
  team.belief.sample_time_ns += 20'000'000'000;
  EXPECT_TRUE(AssignedPlan(team.belief, For("a")).has_value()) << "it is late";
  team.belief.sample_time_ns += 60'000'000'000;
  EXPECT_FALSE(AssignedPlan(team.belief, For("a")).has_value());
}

TEST(AssignedPlan, AWayThatWasClosedSinceIsPlannedAnew) {
  CorridorTeam team = Assigned();
  auto traversable = std::make_shared<Grid<std::uint8_t>>(*team.belief.traversable);
  const Cell there = team.belief.geometry().CellAt(CorridorTeam::At(5.0));
  for (int y = 0; y < traversable->height(); ++y) (*traversable)[Cell{there.x, y}] = 0;
  team.belief.traversable = traversable;
  EXPECT_FALSE(AssignedPlan(team.belief, For("a")).has_value());
}

}  // namespace assigned_plan_test
}  // namespace plumescout
