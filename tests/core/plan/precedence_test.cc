// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/precedence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/plan/right_of_way.h"
#include "core/plan/trajectory_timing.h"
#include "tests/support/corridor_team.h"

namespace plumescout {
namespace precedence_test {

using testing::CorridorTeam;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// "a" waits in the west to go to the east of the corridor; "b" stands in the bay.
CorridorTeam Waiting(double since_s) {
  CorridorTeam team;
  team.Stands("a", 1.0);
  team.Wants("a", 9.0, since_s);
  team.Stands("b", 6.0, 1.8);
  return team;
}

std::vector<KeptWay> KeptFrom(const CorridorTeam& team, const RobotId& robot) {
  return KeptWays(team.belief, robot, PlanningOptions());
}

TEST(KeptWays, AreOfThoseWhoHaveWaitedForLongButNotForEver) {
  EXPECT_THAT(KeptFrom(Waiting(14.0), "b"), IsEmpty());
  const std::vector<KeptWay> kept = KeptFrom(Waiting(16.0), "b");
  ASSERT_THAT(kept, SizeIs(1));
  EXPECT_EQ(kept[0].robot, "a");
  EXPECT_EQ(kept[0].trajectory.waypoints.front().pose.position(), CorridorTeam::At(1.0));
  EXPECT_EQ(kept[0].trajectory.waypoints.back().pose.position(), CorridorTeam::At(9.0));
  EXPECT_EQ(WaitOf_s(kept[0].trajectory), 0.0) << "nobody is in the way";
  EXPECT_THAT(KeptFrom(Waiting(44.0), "b"), SizeIs(1));
  EXPECT_THAT(KeptFrom(Waiting(46.0), "b"), IsEmpty()) << "the others had to wait for long enough";
  EXPECT_THAT(KeptFrom(Waiting(61.0), "b"), SizeIs(1));
  EXPECT_THAT(KeptFrom(Waiting(16.0), "a"), IsEmpty()) << "not from itself";
}

TEST(KeptWays, WhoBeganToWaitEarlierGoesFirst) {
  CorridorTeam team = Waiting(16.0);
  team.Wants("b", 3.0, 20.0);
  EXPECT_THAT(KeptFrom(team, "b"), IsEmpty());
  EXPECT_THAT(KeptFrom(team, "a"), SizeIs(1));
  team.Wants("b", 3.0, 16.0);
  EXPECT_THAT(KeptFrom(team, "b"), SizeIs(1)) << "of equals the first by id";
  EXPECT_THAT(KeptFrom(team, "a"), IsEmpty());
}

TEST(KeptWays, OfThoseWhoBeganTogetherAnotherGoesFirstInTheNextTurn) {
  CorridorTeam team = Waiting(61.0);
  team.Wants("b", 3.0, 61.0);
  EXPECT_THAT(KeptFrom(team, "b"), IsEmpty()) << "\"a\" made nothing of its turn";
  EXPECT_THAT(KeptFrom(team, "a"), SizeIs(1));
  team.Wants("a", 9.0, 106.0);
  team.Wants("b", 3.0, 106.0);
  EXPECT_THAT(KeptFrom(team, "a"), IsEmpty());
  EXPECT_THAT(KeptFrom(team, "b"), SizeIs(1));
}

TEST(KeptWays, WhoHasHadFewerTurnsGoesFirst) {
  CorridorTeam team = Waiting(61.0);
  team.Wants("b", 3.0, 20.0);
  EXPECT_THAT(KeptFrom(team, "b"), IsEmpty());
  EXPECT_THAT(KeptFrom(team, "a"), SizeIs(1));
}

TEST(KeptWays, WhoDrivesOrIsSilentOrCannotPassHasNone) {
  CorridorTeam team = Waiting(16.0);
  team.Stands("c", 4.0);
  EXPECT_THAT(KeptFrom(team, "b"), IsEmpty()) << "\"c\" has to make way";
  const std::vector<KeptWay> kept = KeptFrom(team, "c");
  ASSERT_THAT(kept, SizeIs(1)) << "and is not to end there again";
  EXPECT_EQ(WaitOf_s(kept[0].trajectory), Traffic::kHorizon_s) << "it goes on as it likes";
  team = Waiting(16.0);
  team.belief.robots["a"].state.silent = true;
  EXPECT_THAT(KeptFrom(team, "b"), IsEmpty());
  team = Waiting(16.0);
  team.Drives("a", 2.0);
  EXPECT_THAT(KeptFrom(team, "b"), IsEmpty());
}

TEST(KeptWays, BeginWhenLivePlansLetThem) {
  CorridorTeam team = Waiting(16.0);
  team.Stands("d", 8.0);
  team.Drives("d", 2.0);
  const std::vector<KeptWay> kept = KeptFrom(team, "b");
  ASSERT_THAT(kept, SizeIs(1));
  EXPECT_GE(WaitOf_s(kept[0].trajectory), 28.0) << "\"d\" comes and stays, for all that is known";
}

// The plan of "b" to drive out of the bay to a place.
Plan PlanTo(Point2 place) {
  Plan plan;
  plan.robot = "b";
  Candidate candidate;
  candidate.path = {{6.0, 1.8}, {6.0, CorridorTeam::kMiddle_m}, place};
  candidate.goal.position = place;
  candidate.duration_s = TimeTrajectory(candidate.path, 0.0, PlanningOptions()).duration_s;
  plan.candidates = {candidate};
  return plan;
}

TEST(YieldToRobots, NoWayEndsWhereSomebodyHasWaitedToPass) {
  Plan plan = PlanTo(CorridorTeam::At(8.0));
  YieldToRobots(Waiting(5.0).belief, 0.0, PlanningOptions(), plan);
  EXPECT_THAT(plan.candidates, SizeIs(1));
  plan = PlanTo(CorridorTeam::At(8.0));
  YieldToRobots(Waiting(20.0).belief, 0.0, PlanningOptions(), plan);
  EXPECT_THAT(plan.candidates, IsEmpty());
  ASSERT_THAT(plan.rejected, SizeIs(1));
  EXPECT_EQ(plan.rejected[0].reason, RejectionReason::kTraffic);
  EXPECT_THAT(plan.rejected[0].detail, HasSubstr("robot \"a\""));
  plan = PlanTo({6.0, 1.8});
  plan.candidates[0].path = {{6.0, 1.8}, {5.5, 1.8}};
  YieldToRobots(Waiting(20.0).belief, 0.0, PlanningOptions(), plan);
  EXPECT_THAT(plan.candidates, SizeIs(1)) << "it stays in the bay";
}

TEST(YieldToRobots, NoWaysAreKeptFreeFromWhoGoesHome) {
  Plan plan = PlanTo(CorridorTeam::At(8.0));
  plan.phase = MissionPhase::kReturning;
  YieldToRobots(Waiting(20.0).belief, 0.0, PlanningOptions(), plan);
  EXPECT_THAT(plan.candidates, SizeIs(1)) << "asked to, or for the last time";
  CorridorTeam team = Waiting(20.0);
  team.belief.robots["b"].battery_low = true;
  plan = PlanTo(CorridorTeam::At(8.0));
  YieldToRobots(team.belief, 0.0, PlanningOptions(), plan);
  EXPECT_THAT(plan.candidates, SizeIs(1)) << "sent there";
}

}  // namespace precedence_test
}  // namespace plumescout
