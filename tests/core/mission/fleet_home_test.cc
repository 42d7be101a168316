// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Robots that are sent home, by order or for their battery; and offsets of clocks.
#include <string>

#include "core/mission/fleet.h"
#include "core/mission/observation_check.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace plumescout {
namespace fleet_home_test {

constexpr double kLowShare = 0.2;

Fleet TwoRobots(double low_battery_share = kLowShare) {
  Fleet fleet(60.0, low_battery_share);
  EXPECT_TRUE(fleet.Register({"a", 0.2, 1}, 3).ok());
  EXPECT_TRUE(fleet.Register({"b", 0.2, 2}, 3).ok());
  return fleet;
}

void Tell(Fleet& fleet, const RobotId& robot, double battery_share) {
  const std::int64_t sequence = fleet.AppliedSequence(robot).value() + 1;
  const Observation status{sequence, 1, {9.0, 9.0, 9.0}, RobotStatus{battery_share}};
  ASSERT_TRUE(fleet.CheckSequence(robot, status).ok());
  fleet.Advance(robot, status, false);
}

Plan PlanWith(const RobotId& robot, MissionPhase phase, GoalKind kind, Point2 position) {
  Plan plan;
  plan.robot = robot;
  plan.phase = phase;
  Candidate candidate;
  candidate.goal = {kind, {}, position, position, 10};
  plan.candidates = {candidate};
  plan.chosen = 0;
  plan.trajectory.duration_s = 10.0;
  return plan;
}

Plan Explores(const RobotId& robot, Point2 position) {
  return PlanWith(robot, MissionPhase::kExploring, GoalKind::kOccupancyFrontier, position);
}

Plan Complete(const RobotId& robot) {
  Plan plan;
  plan.robot = robot;
  plan.phase = MissionPhase::kComplete;
  return plan;
}

TEST(FleetHomeTest, StatusSaysNothingOfThePose) {
  Fleet fleet = TwoRobots();
  Tell(fleet, "a", 0.5);
  const RobotRecord record = fleet.Records().at("a");
  EXPECT_EQ(record.state.battery_share, 0.5);
  EXPECT_FALSE(record.state.has_pose);
  EXPECT_FALSE(record.first_place.has_value());
  EXPECT_FALSE(IsSentHome(record));
}

TEST(FleetHomeTest, ALowBatteryHandsTheClaimBackAndIsHomewardUntilItIsCharged) {
  Fleet fleet = TwoRobots();
  ASSERT_TRUE(fleet.Issue(Explores("a", {1.0, 1.0}), 0).ok());
  Tell(fleet, "a", 0.21);
  EXPECT_EQ(fleet.Claims(0).size(), 1U);
  Tell(fleet, "a", 0.19);
  EXPECT_TRUE(fleet.Claims(0).empty());
  EXPECT_TRUE(fleet.Issue(Explores("b", {1.0, 1.0}), 0).ok());
  EXPECT_NE(fleet.Records().at("a").live_trajectory, nullptr) << "it drives there still";
  Tell(fleet, "a", 0.25);
  EXPECT_TRUE(IsSentHome(fleet.Records().at("a"))) << "charge comes back when nothing is drawn";
  Tell(fleet, "a", 0.31);
  EXPECT_FALSE(IsSentHome(fleet.Records().at("a")));
}

TEST(FleetHomeTest, AFullBatteryIsEnoughWhateverTheLimit) {
  Fleet fleet = TwoRobots(0.95);
  Tell(fleet, "a", 0.9);
  EXPECT_TRUE(fleet.Records().at("a").battery_low);
  Tell(fleet, "a", 1.0);
  EXPECT_FALSE(fleet.Records().at("a").battery_low);
}

TEST(FleetHomeTest, WithoutALimitNoBatteryIsLow) {
  Fleet fleet = TwoRobots(0.0);
  Tell(fleet, "a", 0.0);
  EXPECT_FALSE(fleet.Records().at("a").battery_low);
}

TEST(FleetHomeTest, AnOrderEndsTheClaimAndCanBeTakenBack) {
  Fleet fleet = TwoRobots();
  ASSERT_TRUE(fleet.Issue(Explores("a", {1.0, 1.0}), 0).ok());
  ASSERT_TRUE(fleet.OrderHome({"a", true}).ok());
  EXPECT_TRUE(fleet.Claims(0).empty());
  EXPECT_TRUE(IsSentHome(fleet.Records().at("a")));
  ASSERT_TRUE(fleet.OrderHome({"a", false}).ok());
  EXPECT_FALSE(IsSentHome(fleet.Records().at("a")));
  EXPECT_TRUE(fleet.Claims(0).empty()) << "the goal may be another's by now";
  EXPECT_TRUE(absl::IsNotFound(fleet.OrderHome({"c", true})));
}

TEST(FleetHomeTest, NoMissionWaitsForWhoIsSentHome) {
  Fleet fleet = TwoRobots();
  ASSERT_TRUE(fleet.Issue(Explores("a", {1.0, 1.0}), 0).ok());
  ASSERT_TRUE(fleet.Issue(Complete("b"), 0).ok());
  EXPECT_NE(fleet.Phase(), MissionPhase::kComplete);
  ASSERT_TRUE(fleet.OrderHome({"a", true}).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kComplete);
  const Plan home = PlanWith("a", MissionPhase::kReturning, GoalKind::kHome, {0.0, 0.0});
  ASSERT_TRUE(fleet.Issue(home, 0).ok());
  EXPECT_EQ(fleet.Phase(), MissionPhase::kComplete);
}

TEST(FleetHomeTest, WhoLeavesIsOrderedNothingWhenItComesBack) {
  Fleet fleet = TwoRobots();
  Tell(fleet, "a", 0.1);
  ASSERT_TRUE(fleet.OrderHome({"a", true}).ok());
  ASSERT_TRUE(fleet.Remove("a").ok());
  EXPECT_EQ(fleet.Ids(), std::vector<RobotId>{"b"});
  ASSERT_TRUE(fleet.Register({"a", 0.2, 3}, 3).ok());
  const RobotRecord record = fleet.Records().at("a");
  EXPECT_FALSE(IsSentHome(record));
  EXPECT_FALSE(record.state.battery_share.has_value());
}

TEST(FleetHomeTest, RecordsSayWhenARobotWasHeard) {
  Fleet fleet = TwoRobots();
  fleet.Hear("a", 7);
  EXPECT_EQ(fleet.Records().at("a").heard_ns, 7);
}

TEST(FleetClockTest, TakesOffsetsWithinReasonOfKnownRobots) {
  Fleet fleet = TwoRobots();
  EXPECT_TRUE(fleet.NoteClock({"a", -kMaxClockOffset_ns}).ok());
  EXPECT_EQ(fleet.StateOf("a").clock_offset_ns, -kMaxClockOffset_ns);
  const absl::Status absurd = fleet.NoteClock({"a", kMaxClockOffset_ns + 1});
  EXPECT_TRUE(absl::IsInvalidArgument(absurd));
  EXPECT_THAT(std::string(absurd.message()), testing::HasSubstr("offset_ns = 4611686018427387904"));
  EXPECT_EQ(fleet.StateOf("a").clock_offset_ns, -kMaxClockOffset_ns);
  EXPECT_TRUE(absl::IsNotFound(fleet.NoteClock({"c", 1})));
}

}  // namespace fleet_home_test
}  // namespace plumescout
