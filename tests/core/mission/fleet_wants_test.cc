// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What robots want, whom they make way for, and plans that others ordered for them.
#include <gtest/gtest.h>

#include <string>

#include "core/mission/fleet.h"
#include "tests/core/mission/fleet_case.h"

namespace plumescout {
namespace fleet_wants_test {

using support::FleetOf;
using support::kMaxRobots;
using support::kSecond_ns;
using support::PlanTo;

Plan ToStay(const RobotId& robot, double wants_m) {
  Plan plan;
  plan.robot = robot;
  plan.phase = MissionPhase::kExploring;
  plan.rejected = {{{GoalKind::kInformation, {}, {wants_m, 0.0}, {wants_m, 0.0}, 0},
                    RejectionReason::kTraffic,
                    ""}};
  return plan;
}

TEST(FleetWants, WhatOthersAreInTheWayOfIsRememberedSinceTheFirstTime) {
  Fleet fleet = FleetOf({"a", "b"});
  ASSERT_TRUE(fleet.Issue(ToStay("a", 3.0), 5 * kSecond_ns).ok());
  ASSERT_TRUE(fleet.Issue(ToStay("a", 4.0), 9 * kSecond_ns).ok());
  RobotRecord record = fleet.Records().at("a");
  ASSERT_TRUE(record.wanted_goal.has_value());
  EXPECT_EQ(record.wanted_goal->position, (Point2{4.0, 0.0}));
  EXPECT_EQ(record.wanted_since_ns, 5 * kSecond_ns);
  ASSERT_TRUE(fleet.Issue(PlanTo("a", {1.0, 1.0}), 10 * kSecond_ns).ok());
  record = fleet.Records().at("a");
  EXPECT_FALSE(record.wanted_goal.has_value()) << "it has something to do";
  EXPECT_EQ(record.wanted_since_ns, 0);
}

TEST(FleetWants, WhoStaysAWhileForAnotherReasonHasWaitedSinceTheFirstTime) {
  Fleet fleet = FleetOf({"a"});
  ASSERT_TRUE(fleet.Issue(ToStay("a", 3.0), 5 * kSecond_ns).ok());
  Plan stay = ToStay("a", 3.0);
  stay.rejected.clear();
  ASSERT_TRUE(fleet.Issue(stay, 9 * kSecond_ns).ok());
  EXPECT_FALSE(fleet.Records().at("a").wanted_goal.has_value());
  ASSERT_TRUE(fleet.Issue(PlanTo("a", {1.0, 1.0}, GoalKind::kMakeWay), 12 * kSecond_ns).ok());
  ASSERT_TRUE(fleet.Issue(ToStay("a", 3.0), 15 * kSecond_ns).ok());
  const RobotRecord record = fleet.Records().at("a");
  EXPECT_TRUE(record.wanted_goal.has_value());
  EXPECT_EQ(record.wanted_since_ns, 5 * kSecond_ns);
}

TEST(FleetWants, WhoseFrameIsPutElsewhereWantsNothing) {
  Fleet fleet = FleetOf({"a"});
  ASSERT_TRUE(fleet.Issue(ToStay("a", 3.0), 5 * kSecond_ns).ok());
  RobotRegistered again = {"a", 0.2, 2};
  ASSERT_TRUE(fleet.Register(again, kMaxRobots).ok());
  EXPECT_TRUE(fleet.Records().at("a").wanted_goal.has_value()) << "its frame is where it was";
  again.lease_token = 3;
  again.frame.mission_from_robot = {1.0, 0.0, 0.0};
  ASSERT_TRUE(fleet.Register(again, kMaxRobots).ok());
  EXPECT_FALSE(fleet.Records().at("a").wanted_goal.has_value());
  EXPECT_EQ(fleet.Records().at("a").wanted_since_ns, 0);
}

TEST(FleetWants, WhoIsGoneWantsNothing) {
  Fleet fleet = FleetOf({"a", "b"});
  ASSERT_TRUE(fleet.Issue(ToStay("a", 3.0), 0).ok());
  fleet.Hear("a", 0);
  fleet.Hear("b", 1000 * kSecond_ns);
  EXPECT_FALSE(fleet.Records().at("a").wanted_goal.has_value());
}

TEST(FleetMakeWay, ClaimsNoPlaceAndCountsNeitherAsWorkNorAsFruitless) {
  Fleet fleet = FleetOf({"a", "b"});
  Plan plan = PlanTo("a", {1.0, 1.0}, GoalKind::kMakeWay);
  plan.phase = MissionPhase::kFallback;
  const auto id = fleet.Issue(plan, 0);
  ASSERT_TRUE(id.ok());
  EXPECT_TRUE(fleet.Claims(0).empty());
  EXPECT_NE(fleet.Records().at("a").live_trajectory, nullptr);
  const auto ended = fleet.Report({"a", *id, ProgressOutcome::kReached});
  ASSERT_TRUE(ended.ok());
  EXPECT_FALSE(ended->goal.has_value()) << "nothing to set aside";
  EXPECT_EQ(fleet.Records().at("a").fruitless_fallbacks, 0);
}

TEST(FleetMakeWay, ACompleteMissionStaysComplete) {
  Fleet fleet = FleetOf({"a"});
  Plan complete;
  complete.robot = "a";
  complete.phase = MissionPhase::kComplete;
  ASSERT_TRUE(fleet.Issue(complete, 0).ok());
  Plan plan = PlanTo("a", {1.0, 1.0}, GoalKind::kMakeWay);
  plan.phase = MissionPhase::kFallback;
  ASSERT_TRUE(fleet.Issue(plan, 0).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kComplete);
}

TEST(FleetAssigned, APlanStaysAssignedUntilItEndsOrAnotherIsAskedFor) {
  Fleet fleet = FleetOf({"a"});
  const auto first = fleet.Issue(PlanTo("a", {1.0, 1.0}), 0, /*assigned=*/true);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(fleet.Records().at("a").assigned_plan, *first);
  ASSERT_TRUE(fleet.Report({"a", *first, ProgressOutcome::kReached}).ok());
  EXPECT_EQ(fleet.Records().at("a").assigned_plan, 0);
  ASSERT_TRUE(fleet.Issue(PlanTo("a", {2.0, 1.0}), 0, /*assigned=*/true).ok());
  ASSERT_TRUE(fleet.Issue(PlanTo("a", {3.0, 1.0}), 0).ok());
  EXPECT_EQ(fleet.Records().at("a").assigned_plan, 0);
}

}  // namespace fleet_wants_test
}  // namespace plumescout
