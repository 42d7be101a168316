// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/home_goal.h"

#include <gtest/gtest.h>

#include "tests/support/goal_case.h"

namespace plumescout {
namespace home_goal_test {

using testing::GoalCase;

// 'i': free, but too near a wall.
const testing::GridArt kHall = {"############",  //
                                "#iiiiiiiiii#",  //
                                "#i.......Si#",  //
                                "#i..######i#",  //
                                "#i.......#i#",  //
                                "############"};

Point2 CentreOf(const GoalCase& c, Cell cell) { return c.belief.geometry().Center(cell); }

TEST(FindHome, IsWhereTheRobotCameFrom) {
  GoalCase c(kHall);
  c.belief.robots["r"].first_place = CentreOf(c, {3, 1});
  const HomeGoal home = FindHome(c.Query());
  EXPECT_TRUE(home.reachable);
  EXPECT_FALSE(home.is_there);
  EXPECT_EQ(home.goal.kind, GoalKind::kHome);
  EXPECT_EQ(home.goal.cell, (Cell{3, 1}));
  EXPECT_EQ(home.goal.position, CentreOf(c, {3, 1}));
}

TEST(FindHome, IsThatOfTheMissionIfItNamesOne) {
  GoalCase c(kHall);
  c.belief.robots["r"].first_place = CentreOf(c, {3, 1});
  MissionOptions mission;
  mission.home = CentreOf(c, {2, 3});
  c.SetMission(mission);
  EXPECT_EQ(FindHome(c.Query()).goal.cell, (Cell{2, 3}));
}

TEST(FindHome, OfARobotThatHasObservedNothingIsWhereItStarts) {
  const GoalCase c(kHall);
  EXPECT_TRUE(FindHome(c.Query()).is_there);
}

TEST(FindHome, InTheInflatedZoneIsInFrontOfIt) {
  GoalCase c(kHall);
  c.belief.robots["r"].first_place = CentreOf(c, {1, 1});
  const HomeGoal home = FindHome(c.Query());
  EXPECT_TRUE(home.reachable);
  EXPECT_EQ(home.goal.cell, (Cell{2, 1}));
  EXPECT_EQ(home.goal.centroid, CentreOf(c, {1, 1}));
}

TEST(FindHome, FarInUnknownSpaceIsNotReachable) {
  const testing::GridArt art = {"################",  //
                                "#S.????????????#",  //
                                "################"};
  GoalCase c(art);
  c.belief.robots["r"].first_place = CentreOf(c, {5, 1});
  EXPECT_TRUE(FindHome(c.Query()).reachable);
  MissionOptions mission;
  mission.occupancy.inflation_radius_m = 0.0;
  c.SetMission(mission);
  c.belief.robots["r"].first_place = CentreOf(c, {13, 1});
  EXPECT_FALSE(FindHome(c.Query()).reachable);
}

TEST(FindHome, IsReachedWithinAFewCells) {
  GoalCase c(kHall);
  c.belief.robots["r"].first_place = CentreOf(c, {7, 3});
  EXPECT_TRUE(FindHome(c.Query()).is_there);
  c.belief.robots["r"].first_place = CentreOf(c, {5, 3});
  EXPECT_FALSE(FindHome(c.Query()).is_there);
}

TEST(FindHome, BehindWallsOrOffTheMapIsNotReachable) {
  const testing::GridArt parted = {"#######",  //
                                   "#S#...#",  //
                                   "#######"};
  GoalCase c(parted);
  for (const Point2 place : {CentreOf(c, {4, 1}), Point2{-1.0, 0.1}, Point2{1e6, 1e6}}) {
    c.belief.robots["r"].first_place = place;
    const HomeGoal home = FindHome(c.Query());
    EXPECT_FALSE(home.reachable);
    EXPECT_FALSE(home.is_there);
    EXPECT_EQ(home.goal.position, place);
  }
}

TEST(FindHome, IsBesideARobotThatStandsThere) {
  GoalCase c(kHall);
  const Point2 home = CentreOf(c, {3, 1});
  c.belief.robots["r"].first_place = home;
  const double cell_m = c.belief.geometry().resolution_m;
  RobotRecord& parked = c.belief.robots["s"];
  parked.state.id = "s";
  parked.state.radius_m = 1.5 * cell_m;
  parked.state.has_pose = true;
  parked.state.pose = {home.x_m, home.y_m, 0.0};
  c.belief.robots["r"].state.radius_m = cell_m;
  c.options.robot_clearance_m = 0.0;
  const GoalQuery query = c.Query();
  EXPECT_NEAR(Distance_m(FindHome(query).goal.position, home), 3.0 * cell_m, cell_m);
  EXPECT_GE(Distance_m(FindHome(query).goal.position, home), 2.5 * cell_m);
  parked.live_trajectory = std::make_shared<const Trajectory>();
  EXPECT_EQ(FindHome(query).goal.cell, (Cell{3, 1})) << "it is about to leave";
  parked.live_trajectory = nullptr;
  parked.state.silent = true;
  EXPECT_EQ(FindHome(query).goal.cell, (Cell{3, 1}));
}

TEST(FindHome, IsFartherFromARobotWhosePlaceIsInDoubt) {
  GoalCase c(kHall);
  const Point2 home = CentreOf(c, {3, 1});
  c.belief.robots["r"].first_place = home;
  const double cell_m = c.belief.geometry().resolution_m;
  RobotRecord& parked = c.belief.robots["s"];
  parked.state.id = "s";
  parked.state.radius_m = 1.5 * cell_m;
  parked.state.has_pose = true;
  parked.state.pose = {home.x_m, home.y_m, 0.0};
  c.belief.robots["r"].state.radius_m = cell_m;
  c.options.robot_clearance_m = 0.0;
  parked.state.frame.position_stddev_m = cell_m;  // 2.5 cells beside both radii
  EXPECT_EQ(FindHome(c.Query()).goal.cell, (Cell{9, 3})) << "no other cell is 5.7 cells away";
}

TEST(FindHome, IsAsFarFromOthersAsTheRobotsOwnDoubtWhereItIsNow) {
  GoalCase c(kHall);
  const Point2 home = CentreOf(c, {3, 1});
  const Point2 start = CentreOf(c, {9, 3});
  RobotRecord& own = c.belief.robots["r"];
  const double cell_m = c.belief.geometry().resolution_m;
  own.first_place = home;
  own.state.radius_m = cell_m;
  own.state.has_pose = true;
  own.state.pose = {start.x_m, start.y_m, 0.0};
  own.state.frame.mission_from_robot = {home.x_m, home.y_m, 0.0};
  own.state.frame.heading_stddev_rad = cell_m / Distance_m(start, home);  // a cell, and less there
  RobotRecord& parked = c.belief.robots["s"];
  parked.state.id = "s";
  parked.state.radius_m = 1.5 * cell_m;
  parked.state.has_pose = true;
  parked.state.pose = {home.x_m, home.y_m, 0.0};
  c.options.robot_clearance_m = 0.0;
  EXPECT_EQ(FindHome(c.Query()).goal.cell, (Cell{9, 3})) << "no other cell is 5.7 cells away";
}

TEST(FindHome, IsNotKeptFromByMemoryOrClaims) {
  GoalCase c(kHall);
  c.belief.robots["r"].first_place = CentreOf(c, {3, 1});
  const Goal goal = FindHome(c.Query()).goal;
  c.belief.set_aside = {{goal, "reported blocked", 1000}};
  c.belief.claims = {{"other", 1, goal, 1000}};
  EXPECT_TRUE(FindHome(c.Query()).reachable);
}

}  // namespace home_goal_test
}  // namespace plumescout
