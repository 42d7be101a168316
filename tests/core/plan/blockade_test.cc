// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/blockade.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/plan/trajectory_timing.h"
#include "tests/support/corridor_team.h"

namespace plumescout {
namespace blockade_test {

using testing::CorridorTeam;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<BlockedRobot> Blocked(const CorridorTeam& team) {
  return FindBlockedRobots(team.belief, team.belief.robots, PlanningOptions());
}

TEST(FindBlockedRobots, WhoStandsInTheOnlyWayBlocksIt) {
  CorridorTeam team;
  team.Stands("a", 1.0);
  team.Wants("a", 9.0, 3.0);
  team.Stands("b", 5.0);
  const std::vector<BlockedRobot> blocked = Blocked(team);
  ASSERT_THAT(blocked, SizeIs(1));
  EXPECT_EQ(blocked[0].robot, "a");
  EXPECT_THAT(blocked[0].by, ElementsAre("b"));
  EXPECT_DOUBLE_EQ(blocked[0].waits_s, 3.0);
  EXPECT_EQ(blocked[0].way.back(), team.At(9.0));
}

TEST(FindBlockedRobots, WhoIsBehindOrBesideTheWayOrGoneDoesNot) {
  CorridorTeam team;
  team.Stands("a", 5.0);
  team.Wants("a", 9.0, 3.0);
  team.Stands("b", 4.5);
  EXPECT_THAT(Blocked(team), IsEmpty()) << "it stands behind";
  team.Stands("b", 6.0, 1.8);
  EXPECT_THAT(Blocked(team), IsEmpty()) << "it stands in the bay";
  team.Stands("b", 7.0);
  EXPECT_THAT(Blocked(team), SizeIs(1));
  team.belief.robots["b"].state.silent = true;
  EXPECT_THAT(Blocked(team), IsEmpty()) << "nobody knows where it is";
}

TEST(FindBlockedRobots, WhosePlaceIsInDoubtTakesMoreRoom) {
  CorridorTeam team;
  team.Stands("a", 1.0);
  team.Wants("a", 9.0, 3.0);
  team.Stands("b", 6.0, 1.8);
  RobotFrame& frame = team.belief.robots["b"].state.frame;
  frame.position_stddev_m = 0.1;
  EXPECT_THAT(Blocked(team), IsEmpty()) << "2.5 of them are no more than the clearance";
  frame.position_stddev_m = 0.8;
  EXPECT_THAT(Blocked(team), SizeIs(1)) << "it may as well stand in the corridor";
}

TEST(FindBlockedRobots, WhoFollowsItsPlanNeitherBlocksNorIsBlocked) {
  CorridorTeam team;
  team.Stands("a", 1.0);
  team.Wants("a", 9.0, 3.0);
  team.Stands("b", 5.0);
  team.Drives("b", 9.5);
  EXPECT_THAT(Blocked(team), IsEmpty());
  team.belief.sample_time_ns += 12'000'000'000;
  EXPECT_THAT(Blocked(team), SizeIs(1)) << "it has not moved since";
}

TEST(FindRing, WhoWaitForEachOtherAreFoundFromEach) {
  CorridorTeam team;
  team.Stands("a", 3.0);
  team.Wants("a", 9.0, 3.0);
  team.Stands("b", 7.0);
  team.Wants("b", 1.0, 3.0);
  team.Stands("c", 0.9);
  team.Wants("c", 9.5, 3.0);
  const std::vector<BlockedRobot> blocked = Blocked(team);
  ASSERT_THAT(blocked, SizeIs(3));
  for (const char* const robot : {"a", "b"}) {
    EXPECT_THAT(FindRing(blocked, robot), SizeIs(3)) << "c stands where b wants to";
  }
  EXPECT_THAT(FindRing(blocked, "d"), IsEmpty());
  team.Wants("b", 3.2, 3.0);
  EXPECT_THAT(FindRing(Blocked(team), "a"), SizeIs(2));
  EXPECT_THAT(FindRing(Blocked(team), "c"), IsEmpty()) << "nobody waits for it";
}

}  // namespace blockade_test
}  // namespace plumescout
