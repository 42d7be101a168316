// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/goals/frontier_goals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/goal_case.h"

namespace plumescout {
namespace frontier_goals_test {

using testing::GoalCase;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// One frontier in the east, five cells high.
const testing::GridArt kCorridor = {"##########",  //
                                    "#........?",  //
                                    "#........?",  //
                                    "#S.......?",  //
                                    "#........?",  //
                                    "#........?",  //
                                    "##########"};

RejectionReason OnlyRejection(const GoalCase& c) {
  const FrontierGoals found = FindFrontierGoals(c.Query());
  EXPECT_THAT(found.gas, IsEmpty());
  EXPECT_THAT(found.occupancy, IsEmpty());
  EXPECT_THAT(found.rejected, SizeIs(1));
  return found.rejected.at(0).reason;
}

Goal OnlyGoal(const GoalCase& c) { return FindFrontierGoals(c.Query()).occupancy.at(0).goal; }

TEST(FrontierGoals, OfferTheTraversableCellNearestToAFrontier) {
  const GoalCase c(kCorridor);
  const FrontierGoals found = FindFrontierGoals(c.Query());
  ASSERT_THAT(found.occupancy, SizeIs(1));
  const Goal& goal = found.occupancy[0].goal;
  EXPECT_EQ(goal.kind, GoalKind::kOccupancyFrontier);
  EXPECT_EQ(goal.cell, (Cell{8, 3}));
  EXPECT_EQ(goal.position, c.belief.geometry().Center({8, 3}));
  EXPECT_EQ(goal.frontier_cells, 5);
  EXPECT_NEAR(found.occupancy[0].travel_m, 0.7, 1e-6);
  EXPECT_THAT(found.rejected, IsEmpty());
}

TEST(FrontierGoals, OfGasComeFromThePlumeUnlessThePolicyWantsNone) {
  const testing::GridArt art = {"########",  //
                                "#ggg...#",  //
                                "#gSg...#",  //
                                "#ggg...#",  //
                                "########"};
  GoalCase c(art);
  c.AddGas(art, 50.0F);
  const FrontierGoals found = FindFrontierGoals(c.Query());
  ASSERT_THAT(found.gas, SizeIs(1));
  EXPECT_EQ(found.gas[0].goal.kind, GoalKind::kGasFrontier);
  EXPECT_EQ(found.gas[0].goal.cell.x, 4);
  EXPECT_THAT(found.occupancy, IsEmpty());
  c.options.goal_policy = GoalPolicy::kOccupancyOnly;
  EXPECT_THAT(FindFrontierGoals(c.Query()).gas, IsEmpty());
}

TEST(FrontierGoals, OfGasHaveTheirGoalAmongTheirOwnCells) {
  // The frontier is the column right of the plume; its middle cell is too near an obstacle.
  const testing::GridArt art = {"########",  //
                                "#ggg...#",  //
                                "#gSgi..#",  //
                                "#ggg...#",  //
                                "########"};
  GoalCase c(art);
  c.AddGas(art, 50.0F);
  const FrontierGoals found = FindFrontierGoals(c.Query());
  ASSERT_THAT(found.gas, SizeIs(1));
  EXPECT_EQ(found.gas[0].goal.cell, (Cell{4, 1}));
  const double straight_m = 0.1;
  const double diagonal_m = std::sqrt(2.0) * 0.1;
  EXPECT_NEAR(found.gas[0].travel_m, straight_m + diagonal_m, 1e-6);
}

TEST(FrontierGoals, OfGasAreLeftToWhoIsAboutToReadThere) {
  const testing::GridArt art = {"########",  //
                                "#ggg...#",  //
                                "#gSg...#",  //
                                "#ggg...#",  //
                                "########"};
  GoalCase c(art);
  c.AddGas(art, 50.0F);
  Belief ahead = c.belief;
  GoalQuery query = c.Query();
  query.ahead = &ahead;
  ASSERT_THAT(FindFrontierGoals(query).gas, SizeIs(1)) << "nobody reads anything";
  auto variance = std::make_shared<Grid<float>>(*c.belief.gas_variance_ppm2);
  for (int y = 1; y <= 3; ++y) (*variance)[Cell{4, y}] = 0.01F;
  ahead.gas_variance_ppm2 = variance;
  const FrontierGoals found = FindFrontierGoals(query);
  EXPECT_THAT(found.gas, IsEmpty()) << "and the rim beyond is none before it is read";
  ASSERT_THAT(found.rejected, SizeIs(1));
  EXPECT_EQ(found.rejected[0].reason, RejectionReason::kClaimed);
  EXPECT_EQ(found.rejected[0].goal.cell.x, 4);
}

TEST(FrontierGoals, OfGasAreUnreachableWithoutACellToStandOn) {
  const testing::GridArt art = {"######",  //
                                "#gggi#",  //
                                "#gSgi#",  //
                                "#gggi#",  //
                                "######"};
  GoalCase c(art);
  c.AddGas(art, 50.0F);
  EXPECT_EQ(OnlyRejection(c), RejectionReason::kUnreachable);
}

TEST(FrontierGoals, RejectWhatIsTooSmall) {
  GoalCase c(kCorridor);
  MissionOptions mission;
  mission.frontier.min_occupancy_cell_count = 6;
  c.SetMission(mission);
  EXPECT_EQ(OnlyRejection(c), RejectionReason::kTooSmall);
}

TEST(FrontierGoals, AreOnTheRobotsSideOfAGapThatIsTooNarrow) {
  const testing::GridArt art = {"#######",  //
                                "#S.i.?#",  //
                                "#######"};
  const GoalCase c(art);
  const FrontierGoals found = FindFrontierGoals(c.Query());
  ASSERT_THAT(found.occupancy, SizeIs(1));
  EXPECT_EQ(found.occupancy[0].goal.cell, (Cell{2, 1}));
}

TEST(FrontierGoals, RejectWhatIsSetAsideUntilItExpires) {
  GoalCase c(kCorridor);
  c.belief.sample_time_ns = 100;
  c.belief.set_aside = {{OnlyGoal(c), "reported blocked", 101}};
  EXPECT_EQ(OnlyRejection(c), RejectionReason::kSetAside);
  EXPECT_THAT(FindFrontierGoals(c.Query()).rejected.at(0).detail, HasSubstr("reported blocked"));
  c.belief.sample_time_ns = 101;
  EXPECT_THAT(FindFrontierGoals(c.Query()).occupancy, SizeIs(1));
}

TEST(FrontierGoals, RejectWhatAnotherRobotIsOnItsWayTo) {
  GoalCase c(kCorridor);
  Goal near_by = OnlyGoal(c);
  near_by.position.y_m += 0.3;  // its frontier has moved a little since
  c.belief.claims = {{"other", 7, near_by, 1000}};
  EXPECT_EQ(OnlyRejection(c), RejectionReason::kClaimed);
  EXPECT_THAT(FindFrontierGoals(c.Query()).rejected.at(0).detail, HasSubstr("\"other\""));
  c.belief.claims[0].goal.kind = GoalKind::kInformation;
  EXPECT_EQ(OnlyRejection(c), RejectionReason::kClaimed) << "one place, whatever it is for";
  c.belief.claims[0].goal.kind = GoalKind::kRandomFreeSpace;
  EXPECT_THAT(FindFrontierGoals(c.Query()).occupancy, SizeIs(1)) << "it only happens to go there";
  c.belief.sample_time_ns = 1000;  // the claim has run out
  EXPECT_THAT(FindFrontierGoals(c.Query()).occupancy, SizeIs(1));
}

TEST(FrontierGoals, DoNotMindTheRobotsOwnClaim) {
  GoalCase c(kCorridor);
  c.belief.claims = {{"r", 7, OnlyGoal(c), 1000}};
  EXPECT_THAT(FindFrontierGoals(c.Query()).occupancy, SizeIs(1));
}

TEST(FrontierGoals, RejectWhatIsTooClose) {
  GoalCase c(kCorridor);
  c.options.min_goal_distance_m = 0.71;
  EXPECT_EQ(OnlyRejection(c), RejectionReason::kTooClose);
  c.options.min_goal_distance_m = 0.69;
  EXPECT_THAT(FindFrontierGoals(c.Query()).occupancy, SizeIs(1));
}

void KeepOut(GoalCase& c, Cell south_west, Cell north_east) {
  const GridGeometry& geometry = c.belief.geometry();
  const Point2 a = geometry.Center(south_west);
  const Point2 b = geometry.Center(north_east);
  const double half_m = geometry.resolution_m / 2.0;
  MissionOptions mission = *c.belief.options;
  mission.keep_out = {{{{a.x_m - half_m, a.y_m - half_m},
                        {b.x_m + half_m, a.y_m - half_m},
                        {b.x_m + half_m, b.y_m + half_m},
                        {a.x_m - half_m, b.y_m + half_m}}}};
  c.SetMission(mission);
}

TEST(FrontierGoals, RejectWhatLiesInAKeepOutArea) {
  GoalCase c(kCorridor);
  const Cell goal = OnlyGoal(c).cell;
  KeepOut(c, {goal.x - 1, 0}, {goal.x + 5, 10});
  EXPECT_EQ(OnlyRejection(c), RejectionReason::kKeptOut);
}

TEST(FrontierGoals, KeepWhatLiesPartlyInAKeepOutArea) {
  const testing::GridArt art = {"#######",  //
                                "#.....?",  //
                                "#.S...?",  //
                                "#.....?",  //
                                "#######"};
  GoalCase c(art);
  KeepOut(c, {6, 1}, {6, 2});
  EXPECT_THAT(FindFrontierGoals(c.Query()).occupancy, SizeIs(1));
  KeepOut(c, {6, 1}, {6, 3});
  EXPECT_THAT(FindFrontierGoals(c.Query()).occupancy, IsEmpty());
}

}  // namespace frontier_goals_test
}  // namespace plumescout
