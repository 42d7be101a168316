// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/way_left.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/plan/trajectory_timing.h"
#include "core/traffic/traffic.h"
#include "tests/support/plan_map.h"

namespace plumescout {
namespace way_left_test {

using ::testing::ElementsAre;
using ::testing::Optional;
using ::testing::SizeIs;

constexpr std::int64_t kNow_ns = 50'000'000'000;

// A corridor along x of 12 x 1.5 m. Robot "a" drives to its east end, and plans anew at x = 4.05 m.
class WayLeftTest : public ::testing::Test {
 protected:
  WayLeftTest() : reachable_(geometry_, 1), mean_ppm_(geometry_, 0.0F) {
    belief_.sample_time_ns = kNow_ns;
    belief_.options = std::make_shared<const MissionOptions>();
    information_.value = Grid<float>(geometry_, 0.5F);
    information_.penalty = Grid<float>(geometry_, 0.5F);
    information_.min_penalty = 0.5F;
    belief_.robots["a"] = Driving("a", {{1.05, kMiddle_m}, goal_.position}, here_);
    belief_.robots["a"].live_goal = goal_;
    belief_.claims = {
        {.robot = "a", .goal = goal_, .expires_ns = std::numeric_limits<std::int64_t>::max()}};
  }

  static PlanningOptions OptionsByRate() {
    PlanningOptions options;
    options.selection_rule = SelectionRule::kInformationRate;
    return options;
  }
  static RobotRecord Driving(const RobotId& id, const std::vector<Point2>& way, Point2 place,
                             double wait_s = 0.0) {
    RobotRecord robot;
    robot.state.id = id;
    robot.state.radius_m = 0.2;
    robot.state.has_pose = true;
    robot.state.pose = {place.x_m, place.y_m, 0.0};
    Trajectory trajectory = TimeTrajectory(way, 0.0, {});
    if (wait_s > 0.0) WaitAtStart(wait_s, trajectory);
    const double gone_s = wait_s > 0.0 ? 0.0 : FindNearest(trajectory, place)->time_s;
    robot.live_arrival_ns = kNow_ns + std::llround((trajectory.duration_s - gone_s) * 1e9);
    robot.live_trajectory = std::make_shared<const Trajectory>(std::move(trajectory));
    return robot;
  }
  // Another robot is a little way ahead and has the same pace: it is met if it is late.
  void OneGoesAhead() {
    belief_.robots["b"] = Driving("b", {{1.05, kMiddle_m}, {11.6, kMiddle_m}}, {5.05, kMiddle_m});
  }

  Candidate StraightTo(const Goal& goal) const {
    Candidate candidate;
    candidate.goal = goal;
    candidate.path = {here_, goal.position};
    candidate.duration_s = TimeTrajectory(candidate.path, 0.0, {}).duration_s;
    return candidate;
  }
  // GoOnOnWayLeft; returns the waits.
  std::vector<std::optional<double>> GoOn(std::vector<Candidate> candidates) {
    plan_ = {};
    plan_.robot = "a";
    plan_.candidates = std::move(candidates);
    const EdgeCost cost(information_, CostKind::kUcb, 0.0);
    const std::vector<Goal> goals = {goal_};
    const StopFn never = NeverStop();
    const Departure departure = {way_out_, here_, 0.0};
    const GoalQuery query = {
        belief_, belief_.robots.at("a"), geometry_.CellAt(here_), reachable_, options_, go_home_};
    std::optional<Waits> waits = FindWaits(belief_, 0.0, options_, plan_);
    EXPECT_TRUE(waits.has_value());
    GoOnOnWayLeft(
        {query, departure, {cost, reachable_, here_, goals, 1, 0, never}, {cost, mean_ppm_, 0.0}},
        *waits, plan_);
    return waits->waits_s;
  }

  static constexpr double kMiddle_m = 0.75;
  GridGeometry geometry_{0.0, 0.0, 0.1, 120, 15};
  Point2 here_{4.05, kMiddle_m};
  Goal goal_ = testing::GoalAt({100, 7}, geometry_);
  std::vector<Point2> way_out_;
  Belief belief_;
  Grid<std::uint8_t> reachable_;
  Grid<float> mean_ppm_;
  InformationMap information_;
  PlanningOptions options_ = OptionsByRate();
  bool go_home_ = false;
  Plan plan_;
};

TEST_F(WayLeftTest, WhoIsUnderWayWaitsForNobodyWhoKeepsToTheTime) {
  OneGoesAhead();
  belief_.robots["a"].live_trajectory = nullptr;
  const double wait_s = GoOn({StraightTo(goal_)}).front().value_or(1e9);
  EXPECT_GT(wait_s, 0.0) << "a robot that begins has to wait";

  belief_.robots["a"] = Driving("a", {{1.05, kMiddle_m}, goal_.position}, here_);
  belief_.robots["a"].live_goal = goal_;
  EXPECT_THAT(GoOn({StraightTo(goal_)}), ElementsAre(Optional(0.0)));
  EXPECT_THAT(plan_.candidates.front().path, ElementsAre(here_, goal_.position));
}

TEST_F(WayLeftTest, AWayThatNeedsNoWaitIsLeftAlone) {
  belief_.robots["b"] = Driving("b", {{0.35, kMiddle_m}, {1.0, kMiddle_m}}, {0.35, kMiddle_m});
  Candidate bent = StraightTo(goal_);
  bent.path.insert(bent.path.begin() + 1, {6.0, 1.0});
  EXPECT_THAT(GoOn({bent}), ElementsAre(Optional(0.0)));
  EXPECT_THAT(plan_.candidates.front().path, SizeIs(3));
}

TEST_F(WayLeftTest, NobodyDrivesIntoOneThatComesTowardsIt) {
  belief_.robots["b"] = Driving("b", {{11.6, kMiddle_m}, {3.0, kMiddle_m}}, {11.6, kMiddle_m});
  const auto waits = GoOn({StraightTo(goal_)});
  EXPECT_FALSE(waits.front().has_value());
}

TEST_F(WayLeftTest, AWayThatIsShutByNowIsLeft) {
  OneGoesAhead();
  information_.penalty[Cell{80, 7}] = std::numeric_limits<float>::infinity();
  EXPECT_GT(GoOn({StraightTo(goal_)}).front().value_or(1e9), 0.0);
}

TEST_F(WayLeftTest, WhatItLeadsToIsNoMoreIsStillAWay) {
  OneGoesAhead();
  const Goal other = testing::GoalAt({42, 3}, geometry_);
  EXPECT_THAT(GoOn({StraightTo(other)}), SizeIs(2));
  EXPECT_EQ(plan_.candidates[1].goal, goal_);
  EXPECT_EQ(plan_.candidates[1].unseen_share, 0.0);
}

TEST_F(WayLeftTest, NoOtherWayIsOfferedToWhoIsToGoHomeOrGoesByCost) {
  OneGoesAhead();
  const Goal other = testing::GoalAt({42, 3}, geometry_);
  go_home_ = true;
  EXPECT_THAT(GoOn({StraightTo(other)}), SizeIs(1));
  go_home_ = false;
  options_.selection_rule = SelectionRule::kLeastCost;
  EXPECT_THAT(GoOn({StraightTo(other)}), SizeIs(1));
}

TEST_F(WayLeftTest, WhoStandsByPlanStandsForWhatIsLeftOfThat) {
  belief_.robots["b"] = Driving("b", {{11.6, kMiddle_m}, {3.0, kMiddle_m}}, {11.6, kMiddle_m});
  belief_.robots["b"].live_trajectory = nullptr;
  const Goal other = testing::GoalAt({42, 3}, geometry_);
  belief_.robots["a"] = Driving("a", {here_, goal_.position}, here_, 3.0);
  belief_.robots["a"].live_goal = goal_;
  EXPECT_THAT(GoOn({StraightTo(other)}).back(), Optional(::testing::DoubleNear(3.0, 1e-6)));
}

TEST_F(WayLeftTest, WhoStandsByPlanLeavesAtItsTimeIfItKnowsItsPlaceButNearly) {
  belief_.robots["b"] = Driving("b", {{0.35, kMiddle_m}, {1.0, kMiddle_m}}, {0.35, kMiddle_m});
  const Goal other = testing::GoalAt({42, 3}, geometry_);
  belief_.robots["a"] = Driving("a", {here_, goal_.position}, here_, 3.0);
  belief_.robots["a"].live_goal = goal_;
  here_.x_m += 0.08;
  EXPECT_THAT(GoOn({StraightTo(other)}).back(), Optional(::testing::DoubleNear(3.0, 1e-6)));
  EXPECT_THAT(plan_.candidates.back().path, ElementsAre(here_, goal_.position));
}

TEST_F(WayLeftTest, WhoStandsNearAnObstacleGoesOnAsItWasTo) {
  belief_.robots["b"] = Driving("b", {{0.35, kMiddle_m}, {1.0, kMiddle_m}}, {0.35, kMiddle_m});
  const Goal other = testing::GoalAt({42, 3}, geometry_);
  const Point2 bend = {6.05, kMiddle_m + 0.1};
  belief_.robots["a"] = Driving("a", {here_, bend, goal_.position}, here_, 3.0);
  belief_.robots["a"].live_goal = goal_;
  belief_.occupancy = std::make_shared<const Grid<CellState>>(geometry_, CellState::kFree);
  Grid<std::uint8_t> traversable(geometry_, 1);
  for (int y = 0; y < geometry_.height; ++y) traversable[Cell{40, y}] = 0;
  belief_.traversable = std::make_shared<const Grid<std::uint8_t>>(traversable);
  way_out_ = {here_};
  EXPECT_THAT(GoOn({StraightTo(other)}).back(), Optional(::testing::DoubleNear(3.0, 1e-6)));
  EXPECT_THAT(plan_.candidates.back().path, ElementsAre(here_, bend, goal_.position));

  for (int y = 0; y < geometry_.height; ++y) traversable[Cell{80, y}] = 0;
  belief_.traversable = std::make_shared<const Grid<std::uint8_t>>(traversable);
  EXPECT_THAT(GoOn({StraightTo(other)}), SizeIs(1)) << "shut farther on";
}

TEST_F(WayLeftTest, WhoHasStrayedHasNoWayLeft) {
  OneGoesAhead();
  belief_.robots["a"].state.pose.y_m += 0.6;
  EXPECT_GT(GoOn({StraightTo(goal_)}).front().value_or(1e9), 0.0);
}

class ReplanAfterTest : public ::testing::Test {
 protected:
  ReplanAfterTest() {
    plan_.robot = "a";
    plan_.chosen = 0;
    options_.selection_rule = SelectionRule::kInformationRate;
    belief_.robots["a"].state.has_pose = true;
    belief_.robots["b"].state.has_pose = true;
  }
  double Period_s() const { return ReplanAfter_s(belief_, options_, plan_); }

  Belief belief_;
  PlanningOptions options_;
  Plan plan_;
};

TEST_F(ReplanAfterTest, RobotsOfATeamLearnOnTheirWay) {
  EXPECT_EQ(Period_s(), options_.team_replan_period_s);
  options_.team_replan_period_s = 0.0;
  EXPECT_EQ(Period_s(), 0.0);
}

TEST_F(ReplanAfterTest, NobodyElseTellsAnything) {
  belief_.robots["b"].state.silent = true;
  EXPECT_EQ(Period_s(), 0.0);
  belief_.robots["b"] = {};
  EXPECT_EQ(Period_s(), 0.0) << "it has not been heard of";
  belief_.robots.erase("b");
  EXPECT_EQ(Period_s(), 0.0);
}

TEST_F(ReplanAfterTest, NotWhereNothingWouldBeBetterThen) {
  plan_.chosen = -1;
  EXPECT_EQ(Period_s(), 0.0) << "it stays";
  plan_.chosen = 0;
  plan_.phase = MissionPhase::kReturning;
  EXPECT_EQ(Period_s(), 0.0);
  plan_.phase = MissionPhase::kExploring;
  options_.dwell_s = 2.0;
  EXPECT_EQ(Period_s(), 0.0) << "it samples where it is";
  options_.dwell_s = 0.0;
  options_.selection_rule = SelectionRule::kLeastCost;
  EXPECT_EQ(Period_s(), 0.0);
}

}  // namespace way_left_test
}  // namespace plumescout
