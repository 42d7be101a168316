// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/trajectory_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/plan/trajectory_timing.h"
#include "tests/support/site_case.h"
#include "tests/support/strategy_case.h"

namespace plumescout {
namespace trajectory_check_test {

using ::testing::ElementsAre;

constexpr double kRounding = 1e-9;

// A frontier of three cells in the east.
const testing::GridArt kHall = {"##########",  //
                                "#........?",  //
                                "#S.......?",  //
                                "#........?",  //
                                "##########"};

Belief Hall() { return testing::SmallBelief(kHall); }

Point2 At(const Belief& belief, Cell cell) { return belief.geometry().Center(cell); }

IntendedPath East(const Belief& belief, GoalKind kind = GoalKind::kOccupancyFrontier) {
  return PathTo(kind, {At(belief, {1, 2}), At(belief, {8, 2})}, belief.geometry());
}

void SetState(Belief& belief, Cell cell, CellState state, bool traversable) {
  Grid<CellState> states = *belief.occupancy;
  Grid<std::uint8_t> open = *belief.traversable;
  states[cell] = state;
  open[cell] = traversable ? 1 : 0;
  belief.occupancy = std::make_shared<const Grid<CellState>>(states);
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(open);
}

TrajectoryVerdict Check(const Belief& belief, const IntendedPath& path) {
  return CheckTrajectory(belief, "r", path, {});
}

// The rejection of a goal whose path may be what it likes.
RejectionReason Objection(const Belief& belief, const IntendedPath& path) {
  const TrajectoryVerdict check = Check(belief, path);
  EXPECT_TRUE(check.rejection.has_value());
  return check.rejection ? check.rejection->reason : RejectionReason::kNotDrawn;
}

TEST(CheckTrajectory, FindsNothingWrongWhileNothingChanges) {
  const Belief belief = Hall();
  const TrajectoryVerdict check = Check(belief, East(belief));
  EXPECT_FALSE(check.blockage.has_value());
  EXPECT_FALSE(check.rejection.has_value());
  ASSERT_TRUE(check.rest.has_value());
  EXPECT_NEAR(check.rest->length_m, 0.7, kRounding);
}

TEST(CheckTrajectory, AcceptsTheOwnPlansOfThePlanner) {
  for (const testing::GridArt& art : {kHall, testing::kRoom}) {
    const Belief belief = testing::SmallBelief(art);
    const auto plan = testing::TryPlan(belief, testing::For("r"));
    ASSERT_TRUE(plan.ok()) << plan.status();
    for (const Candidate& candidate : plan->candidates) {
      const TrajectoryVerdict check = Check(belief, {candidate.path, candidate.goal});
      EXPECT_FALSE(check.blockage.has_value());
      EXPECT_FALSE(check.rejection.has_value());
      ASSERT_TRUE(check.rest.has_value());
      EXPECT_NEAR(check.rest->cost, candidate.cost, kRounding);
      EXPECT_NEAR(check.rest->length_m, candidate.length_m, kRounding);
      EXPECT_NEAR(check.rest->duration_s, candidate.duration_s, kRounding);
    }
  }
}

TEST(CheckTrajectory, NamesTheFirstBlockedCellAndTheWayToIt) {
  Belief belief = Hall();
  SetState(belief, {5, 2}, CellState::kOccupied, false);
  SetState(belief, {7, 2}, CellState::kOccupied, false);
  const TrajectoryVerdict check = Check(belief, East(belief));
  ASSERT_TRUE(check.blockage.has_value());
  EXPECT_EQ(check.blockage->cell, (Cell{5, 2}));
  EXPECT_EQ(check.blockage->state, CellState::kOccupied);
  EXPECT_NEAR(check.blockage->distance_m, 0.35, kRounding) << "from the centre of the first cell";
  EXPECT_NEAR(check.blockage->position.x_m, 0.5, kRounding);
  EXPECT_NEAR(check.blockage->position.y_m, 0.25, kRounding);
  EXPECT_FALSE(check.rest.has_value());
  EXPECT_FALSE(check.rejection.has_value()) << "there is another way";
}

TEST(CheckTrajectory, CountsTheWayOverAllSegments) {
  Belief belief = Hall();
  SetState(belief, {5, 3}, CellState::kFree, false);
  const IntendedPath path =
      PathTo(GoalKind::kRandomFreeSpace,
             {At(belief, {1, 2}), At(belief, {3, 2}), At(belief, {3, 3}), At(belief, {8, 3})},
             belief.geometry());
  const TrajectoryVerdict check = Check(belief, path);
  ASSERT_TRUE(check.blockage.has_value());
  EXPECT_EQ(check.blockage->state, CellState::kFree) << "too near an obstacle";
  EXPECT_NEAR(check.blockage->distance_m, 0.2 + 0.1 + 0.15, kRounding);
}

TEST(CheckTrajectory, UnknownAndOffTheMapAreBlocked) {
  Belief belief = Hall();
  IntendedPath path =
      PathTo(GoalKind::kRandomFreeSpace, {At(belief, {1, 2}), {5.0, 0.25}}, belief.geometry());
  EXPECT_EQ(Check(belief, path).blockage.value().state, CellState::kUnknown);
  path.vertices = {{-3.0, 0.25}, At(belief, {1, 2})};
  const TrajectoryVerdict check = Check(belief, path);
  EXPECT_FALSE(check.blockage.value().state.has_value());
  EXPECT_EQ(check.blockage->distance_m, 0.0);
  EXPECT_EQ(check.rejection.value().reason, RejectionReason::kUnreachable);
}

TEST(CheckTrajectory, MayLeadOutOfTheInflatedZoneButNotThroughAnother) {
  const Belief belief = testing::SmallBelief({"###########",  //
                                              "#ii..i....?",  //
                                              "#ii..i....?",  //
                                              "#ii..i....?",  //
                                              "###########"});
  const IntendedPath out = PathTo(GoalKind::kRandomFreeSpace,
                                  {At(belief, {1, 3}), At(belief, {4, 3})}, belief.geometry());
  EXPECT_FALSE(Check(belief, out).blockage.has_value());
  const IntendedPath on = PathTo(GoalKind::kRandomFreeSpace,
                                 {At(belief, {1, 3}), At(belief, {8, 3})}, belief.geometry());
  EXPECT_EQ(Check(belief, on).blockage.value().cell, (Cell{5, 3}));
  const IntendedPath within = PathTo(GoalKind::kRandomFreeSpace,
                                     {At(belief, {1, 3}), At(belief, {2, 3})}, belief.geometry());
  EXPECT_EQ(Check(belief, within).blockage.value().cell, (Cell{2, 3})) << "it does not get out";
}

TEST(CheckTrajectory, OfOnePointIsAboutItsCell) {
  Belief belief = Hall();
  const IntendedPath path =
      PathTo(GoalKind::kRandomFreeSpace, {At(belief, {4, 2})}, belief.geometry());
  ASSERT_TRUE(Check(belief, path).rest.has_value());
  EXPECT_EQ(Check(belief, path).rest->length_m, 0.0);
  SetState(belief, {4, 2}, CellState::kOccupied, false);
  EXPECT_EQ(Check(belief, path).blockage.value().distance_m, 0.0);
}

TEST(CheckTrajectory, AFrontierThatMovedALittleIsStillWorthIt) {
  const Belief belief = Hall();
  IntendedPath path = East(belief);
  path.goal.position.x_m -= 0.3;
  EXPECT_FALSE(Check(belief, path).rejection.has_value());
}

TEST(CheckTrajectory, AFrontierInFrontOfTheRobotIsStillWorthIt) {
  const Belief belief = Hall();
  PlanningOptions options = testing::XitGff();
  options.min_goal_distance_m = 5.0;
  EXPECT_FALSE(CheckTrajectory(belief, "r", East(belief), options).rejection.has_value());
}

TEST(CheckTrajectory, AFrontierThatIsKnownByNowIsGone) {
  Belief belief = Hall();
  for (int y = 1; y <= 3; ++y) SetState(belief, {9, y}, CellState::kOccupied, false);
  EXPECT_EQ(Objection(belief, East(belief)), RejectionReason::kGone);
  EXPECT_EQ(Objection(Hall(), East(belief, GoalKind::kGasFrontier)), RejectionReason::kGone);
}

TEST(CheckTrajectory, AFrontierBehindAWallIsGone) {
  Belief belief = Hall();
  for (int y = 1; y <= 3; ++y) SetState(belief, {5, y}, CellState::kOccupied, false);
  EXPECT_EQ(Objection(belief, East(belief)), RejectionReason::kGone);
}

TEST(CheckTrajectory, WithoutAWayOutOfWhereItStandsTheRobotReachesNoGoal) {
  Belief belief = Hall();
  for (const Cell cell : {Cell{1, 1}, Cell{1, 2}, Cell{1, 3}}) {
    SetState(belief, cell, CellState::kFree, false);
  }
  for (int y = 1; y <= 3; ++y) SetState(belief, {2, y}, CellState::kOccupied, false);
  const IntendedPath path = East(belief, GoalKind::kRandomFreeSpace);
  EXPECT_EQ(Objection(belief, path), RejectionReason::kUnreachable);
}

TEST(CheckTrajectory, GoalsOfOthersAndThoseSetAsideAreNotWorthIt) {
  for (const GoalKind kind : {GoalKind::kOccupancyFrontier, GoalKind::kRandomFreeSpace}) {
    const Belief free = Hall();
    const IntendedPath path = East(free, kind);
    Belief claimed = free;
    claimed.claims = {{"other", 3, path.goal, 1'000'000'000}};
    EXPECT_EQ(Objection(claimed, path), RejectionReason::kClaimed);
    Belief own = free;
    own.claims = {{"r", 3, path.goal, 1'000'000'000}};
    EXPECT_FALSE(Check(own, path).rejection.has_value());
    Belief aside = free;
    aside.set_aside = {{path.goal, "reported blocked", 1'000'000'000}};
    EXPECT_EQ(Objection(aside, path), RejectionReason::kSetAside);
  }
}

TEST(CheckTrajectory, HomeIsWorthItWhileThereIsAWay) {
  Belief belief = Hall();
  MissionOptions mission = *belief.options;
  mission.home = At(belief, {8, 2});
  belief.options = std::make_shared<const MissionOptions>(mission);
  const IntendedPath path = East(belief, GoalKind::kHome);
  EXPECT_FALSE(Check(belief, path).rejection.has_value());
  for (int y = 1; y <= 3; ++y) SetState(belief, {5, y}, CellState::kOccupied, false);
  EXPECT_EQ(Objection(belief, path), RejectionReason::kUnreachable);
}

// Robot r drives its plan 4 from (0.15, 0.25) to (0.85, 0.25), by a corner.
Belief Driving() {
  Belief belief = Hall();
  RobotRecord& robot = belief.robots["r"];
  robot.last_plan = 4;
  robot.live_goal = East(belief).goal;
  PlanningOptions options = testing::XitGff();
  options.max_acceleration_mps2 = 0.5;
  robot.live_trajectory = std::make_shared<const Trajectory>(
      TimeTrajectory({At(belief, {1, 2}), At(belief, {4, 2}), At(belief, {8, 1})}, 0.0, options));
  return belief;
}

TEST(RestOfPlan, BeginsWhereTheRobotIs) {
  Belief belief = Driving();
  belief.robots["r"].state.pose = {0.3, 0.27, 0.0};
  const auto rest = RestOfPlan(belief, "r", 4);
  ASSERT_TRUE(rest.ok()) << rest.status();
  EXPECT_EQ(rest->goal, belief.robots["r"].live_goal);
  ASSERT_EQ(rest->vertices.size(), 3u) << "changes of speed are no vertices";
  EXPECT_NEAR(rest->vertices[0].x_m, 0.3, kRounding);
  EXPECT_NEAR(rest->vertices[0].y_m, 0.25, kRounding);
  EXPECT_EQ(rest->vertices[2], At(belief, {8, 1}));
}

TEST(RestOfPlan, AtItsEndIsOnePoint) {
  Belief belief = Driving();
  const Point2 end = At(belief, {8, 1});
  belief.robots["r"].state.pose = {end.x_m, end.y_m, 0.0};
  const auto rest = RestOfPlan(belief, "r", 4);
  ASSERT_TRUE(rest.ok()) << rest.status();
  EXPECT_THAT(rest->vertices, ElementsAre(end));
}

TEST(RestOfPlan, IsOnlyOfTheLatestAndWhileItLives) {
  Belief belief = Driving();
  belief.robots["s"].last_plan = 6;
  EXPECT_EQ(RestOfPlan(belief, "t", 4).status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(RestOfPlan(belief, "r", 7).status().code(), absl::StatusCode::kNotFound);
  for (const PlanId other : {3, 6}) {
    EXPECT_THAT(std::string(RestOfPlan(belief, "r", other).status().message()),
                ::testing::StartsWith("PLAN_SUPERSEDED: "));
  }
  EXPECT_THAT(std::string(RestOfPlan(belief, "s", 6).status().message()),
              ::testing::StartsWith("PLAN_ENDED: "));
}

// A robot on its way along a corridor to sample three sites of it, the second on its straight way.
struct Sampling {
  Sampling() {
    RobotRecord& robot = belief.robots["r"];
    robot.last_plan = 4;
    robot.live_goal = Goal{GoalKind::kSite, {17, 0}, At(17), At(17), 0};
    robot.live_trajectory = std::make_shared<const Trajectory>(
        TimeTrajectory({At(0), At(5), At(10), At(17)}, {At(5), At(10), At(17)}, 0.0, options));
  }
  Point2 At(int x) const { return belief.geometry().Center({x, 0}); }
  IntendedPath Rest() const { return RestOfPlan(belief, "r", 4).value(); }
  TrajectoryVerdict Check() const { return CheckTrajectory(belief, "r", Rest(), options); }

  Belief belief = testing::SiteBelief(testing::OpenArt(20, 1));
  PlanningOptions options = testing::SiteOptionsOf("lhr", belief.geometry());
};

TEST(RestOfPlan, KeepsTheStopsThatAreLeft) {
  Sampling c;
  EXPECT_THAT(c.Rest().stops, ElementsAre(c.At(5), c.At(10), c.At(17)));
  EXPECT_THAT(c.Rest().vertices, ElementsAre(c.At(0), c.At(5), c.At(10), c.At(17)));
  testing::MovePose(c.belief, c.At(7));
  EXPECT_THAT(c.Rest().stops, ElementsAre(c.At(10), c.At(17)));
  EXPECT_NEAR(Distance_m(c.Rest().vertices.at(0), c.At(7)), 0.0, kRounding);
}

TEST(CheckTrajectory, TimesTheStopsOfARobotThatSamples) {
  Sampling c;
  EXPECT_NEAR(c.Check().rest.value().duration_s, 1.7 + 3 * 2.0, kRounding);
  testing::MovePose(c.belief, c.At(7));
  EXPECT_NEAR(c.Check().rest.value().duration_s, 1.0 + 2 * 2.0, kRounding);
  EXPECT_EQ(c.Check().rest->stops.size(), 2u);
}

TEST(CheckTrajectory, SitesAreGoneWhenAllOfThemHaveBeenSampled) {
  Sampling c;
  testing::SetSampled(c.belief, {{10, 0}, {17, 0}});
  EXPECT_FALSE(c.Check().rejection.has_value()) << "one is left";
  testing::SetSampled(c.belief, {{5, 0}});
  ASSERT_TRUE(c.Check().rejection.has_value());
  EXPECT_EQ(c.Check().rejection->reason, RejectionReason::kGone);
  c.options = testing::SiteOptionsOf("ipp_reward", c.belief.geometry());
  EXPECT_FALSE(c.Check().rejection.has_value()) << "its rewards may bring it back";
  c.options.sites.reward = SamplingReward::kConcentrationPerTime;
  EXPECT_TRUE(c.Check().rejection.has_value());
}

TEST(CheckTrajectory, ASiteBehindAWallIsUnreachable) {
  Sampling c;
  SetState(c.belief, {12, 0}, CellState::kOccupied, false);
  EXPECT_EQ(c.Check().rejection.value().reason, RejectionReason::kUnreachable);
  EXPECT_EQ(c.Check().blockage.value().cell, (Cell{12, 0}));
}

TEST(PathTo, ASiteStopsThere) {
  const Belief belief = Hall();
  EXPECT_THAT(East(belief, GoalKind::kSite).stops, ElementsAre(At(belief, {8, 2})));
  EXPECT_TRUE(East(belief).stops.empty());
}

}  // namespace trajectory_check_test
}  // namespace plumescout
