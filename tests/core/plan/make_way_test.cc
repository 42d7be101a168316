// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/make_way.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/plan/right_of_way.h"
#include "core/traffic/traffic.h"
#include "tests/support/corridor_team.h"

namespace plumescout {
namespace make_way_test {

using testing::CorridorTeam;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// What becomes of the robot's plan to stay; it wants to go to `wants_m`, if that is not negative.
Plan Planned(const CorridorTeam& team, const RobotId& robot, double wants_m = -1.0,
             const PlanningOptions& options = {}) {
  Plan plan;
  plan.robot = robot;
  plan.end = PlanEnd::kMissionComplete;
  plan.phase = MissionPhase::kComplete;
  if (wants_m >= 0.0) {
    const Point2 goal = CorridorTeam::At(wants_m);
    plan.rejected.push_back({{GoalKind::kHome, team.belief.geometry().CellAt(goal), goal, goal, 0},
                             RejectionReason::kTraffic,
                             ""});
    plan.end = PlanEnd::kAllGoalsRejected;
  }
  const Point2 place = team.belief.robots.at(robot).state.pose.position();
  MakeWay(team.belief, {{}, place, 0.0}, options, NeverStop(), plan);
  return plan;
}

// "a" waits in the west for somebody else to leave the corridor.
CorridorTeam Waiting(double since_s) {
  CorridorTeam team;
  team.Stands("a", 1.0);
  team.Wants("a", 9.0, since_s);
  return team;
}

TEST(MakeWay, WhoHasNothingToDoDrivesIntoTheBay) {
  CorridorTeam team = Waiting(0.0);
  team.Stands("b", 4.0);
  const Plan plan = Planned(team, "b");
  ASSERT_EQ(plan.chosen, 0);
  const Candidate& chosen = plan.candidates[0];
  EXPECT_EQ(chosen.goal.kind, GoalKind::kMakeWay);
  EXPECT_GE(chosen.goal.position.y_m - CorridorTeam::kMiddle_m, 0.65);
  EXPECT_LT(chosen.goal.position.y_m - CorridorTeam::kMiddle_m, 0.9) << "not farther than needed";
  EXPECT_EQ(plan.phase, MissionPhase::kFallback) << "it is not complete while it drives";
  EXPECT_EQ(plan.end, PlanEnd::kAllGoalsReached);
  EXPECT_DOUBLE_EQ(plan.trajectory.waypoints.back().dwell_s, kStandAside_s);
  EXPECT_DOUBLE_EQ(plan.trajectory.duration_s, chosen.duration_s);
  EXPECT_THAT(plan.explanation, HasSubstr("to make way for \"a\""));
}

TEST(MakeWay, TheWayIsKeptFromByTheDoubtOfWhereTheOtherIsNow) {
  CorridorTeam team = Waiting(0.0);
  team.Stands("b", 4.0);
  RobotFrame& frame = team.belief.robots["a"].state.frame;
  frame.mission_from_robot = {6.0, CorridorTeam::kMiddle_m, 0.0};  // before the bay it is sure
  frame.heading_stddev_rad = 0.03;                                 // 5 m from there
  const Plan plan = Planned(team, "b");
  ASSERT_EQ(plan.chosen, 0);
  const double off_m = plan.candidates[0].goal.position.y_m - CorridorTeam::kMiddle_m;
  EXPECT_GE(off_m, 0.4 + 2.5 * 0.03 * 5.0);
}

TEST(MakeWay, NoRetreatEndsOnAWayThatIsKeptForAnother) {
  CorridorTeam team = Waiting(0.0);
  team.Wants("a", 4.5, 0.0);
  team.Stands("b", 4.0);
  team.Stands("c", 9.5);
  Plan plan = Planned(team, "b");
  ASSERT_EQ(plan.chosen, 0);
  EXPECT_LT(plan.candidates[0].goal.position.y_m, 0.7) << "the corridor before the bay is nearest";
  team.Wants("c", 5.3, 16.0);
  plan = Planned(team, "b");
  ASSERT_EQ(plan.chosen, 0);
  EXPECT_GT(plan.candidates[0].goal.position.y_m, 0.7) << "it goes into the bay";
}

TEST(MakeWay, WhoIsInNobodysWayStays) {
  CorridorTeam team = Waiting(60.0);
  team.Stands("b", 6.0, 1.8);
  const Plan plan = Planned(team, "b");
  EXPECT_EQ(plan.chosen, -1);
  EXPECT_EQ(plan.end, PlanEnd::kMissionComplete);
  team.Stands("b", 4.0);
  PlanningOptions pass_through;
  pass_through.yield_to_robots = false;
  EXPECT_EQ(Planned(team, "b", -1.0, pass_through).chosen, -1);
}

TEST(MakeWay, WithoutAPlaceToGoToItStays) {
  CorridorTeam team = Waiting(60.0);
  team.Wants("a", 9.9, 60.0);
  team.Stands("b", 8.5);
  team.Stands("c", 7.5);
  EXPECT_EQ(Planned(team, "b").chosen, -1) << "behind another there is only the dead end";
}

TEST(MakeWay, SomebodyElsesGoalIsNoPlaceToStand) {
  CorridorTeam team = Waiting(60.0);
  team.Stands("b", 4.0);
  const Point2 place = Planned(team, "b").candidates.at(0).goal.position;
  team.belief.claims.push_back({"a", 1, {GoalKind::kInformation, {}, place, place, 0}, 1});
  const Plan plan = Planned(team, "b");
  ASSERT_THAT(plan.candidates, SizeIs(1));
  EXPECT_GE(Distance_m(plan.candidates[0].goal.position, place), kClaimRadius_m);
}

TEST(MakeWay, OfTwoThatWaitForEachOtherTheOneWithTheShorterWayBacksOff) {
  CorridorTeam team = Waiting(6.0);
  team.Stands("b", 8.0);
  team.Wants("b", 0.5, 6.0);
  EXPECT_EQ(Planned(team, "a", 9.0).chosen, -1) << "it has farther to the bay";
  const Plan plan = Planned(team, "b", 0.5);
  ASSERT_EQ(plan.chosen, 0);
  EXPECT_THAT(plan.explanation, HasSubstr("to break the deadlock with \"a\""));
  EXPECT_EQ(plan.end, PlanEnd::kQueueExhausted);
  EXPECT_THAT(plan.rejected, SizeIs(1)) << "what it wants is still told";
}

TEST(MakeWay, TheyWaitALittleBeforeAndTheOtherGoesWhenTheFirstDoesNot) {
  CorridorTeam team = Waiting(4.0);
  team.Stands("b", 8.0);
  team.Wants("b", 0.5, 60.0);
  EXPECT_EQ(Planned(team, "b", 0.5).chosen, -1);
  team.Wants("a", 9.0, 11.0);
  EXPECT_EQ(Planned(team, "a", 9.0).chosen, 0);
}

TEST(MakeWay, WhoWantsSomethingElseMakesWayWhenTheOtherHasWaited) {
  CorridorTeam team = Waiting(3.0);
  team.Stands("b", 4.0);
  team.belief.robots["b"].wanted_goal = std::nullopt;
  EXPECT_EQ(Planned(team, "b", 9.5).chosen, -1) << "it may soon go on";
  team.Wants("a", 9.0, 6.0);
  EXPECT_EQ(Planned(team, "b", 9.5).chosen, 0);
}

TEST(MakeWay, APlanToGoSomewhereStaysAsItIs) {
  CorridorTeam team = Waiting(60.0);
  team.Stands("b", 4.0);
  Plan plan;
  plan.robot = "b";
  plan.candidates.resize(2);
  plan.chosen = 1;
  const Plan before = plan;
  MakeWay(team.belief, {{}, CorridorTeam::At(4.0), 0.0}, {}, NeverStop(), plan);
  EXPECT_EQ(plan, before);
}

}  // namespace make_way_test
}  // namespace plumescout
