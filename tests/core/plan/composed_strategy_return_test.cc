// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// ComposedStrategy with a home to return to, a travel budget, and limits of motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/grid/grid_search.h"
#include "core/plan/composed_strategy.h"
#include "lab/worlds/random_world.h"
#include "tests/support/goal_case.h"
#include "tests/support/rounds.h"
#include "tests/support/strategy_case.h"

namespace plumescout {
namespace composed_strategy_return_test {

using testing::Chosen;
using testing::For;
using ::testing::HasSubstr;
using testing::kRoom;
using ::testing::Not;
using ::testing::SizeIs;
using testing::SmallBelief;
using testing::TryPlan;

constexpr double kRounding = 1e-9;

const testing::GridArt kClosed = {"########",  //
                                  "#gggggg#",  //
                                  "#gSgggg#",  //
                                  "########"};

// As in kRoom the west is 0.3 m away and the east 1.1 m.
Belief FromTheEast() {
  Belief belief = SmallBelief(kRoom);
  belief.robots["r"].first_place = belief.geometry().Center({13, 5});
  return belief;
}

TEST(StrategyReturn, DrivesHomeOnRequest) {
  PlanRequest request = For("r");
  request.go_home = true;
  const absl::StatusOr<Plan> plan = TryPlan(FromTheEast(), request);
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(plan->phase, MissionPhase::kReturning);
  ASSERT_THAT(plan->candidates, SizeIs(1));
  EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kHome);
  EXPECT_EQ(Chosen(*plan).goal.cell, (Cell{13, 5}));
  EXPECT_THAT(plan->explanation, HasSubstr("to home"));
}

TEST(StrategyReturn, DrivesHomeByOrderAndSaysWhy) {
  Belief belief = FromTheEast();
  belief.robots["r"].state.ordered_home = true;
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r"));
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(plan->phase, MissionPhase::kReturning);
  EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kHome);
  EXPECT_THAT(plan->explanation, HasSubstr("ordered the robot home"));
}

TEST(StrategyReturn, StaysIfItIsHomeOrHasNoWay) {
  Belief belief = SmallBelief(kRoom);
  PlanRequest request = For("r");
  request.go_home = true;
  absl::StatusOr<Plan> plan = TryPlan(belief, request);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->phase, MissionPhase::kReturning);
  EXPECT_EQ(plan->end, PlanEnd::kNoGoals);
  EXPECT_THAT(plan->explanation, HasSubstr("the robot is home"));
  belief.robots["r"].first_place = Point2{-9.0, 0.0};
  plan = TryPlan(belief, request);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->chosen, -1);
  EXPECT_THAT(plan->rejected, SizeIs(1));
  EXPECT_THAT(plan->explanation, HasSubstr("no way home"));
}

TEST(StrategyReturn, DoesNotTakeARobotThatIsWalledInForHome) {
  Belief belief = SmallBelief({"#####",  //
                               "##S##",  //
                               "#####"});
  belief.traversable = std::make_shared<const Grid<std::uint8_t>>(belief.geometry(), 0);
  PlanRequest request = For("r");
  request.go_home = true;
  const absl::StatusOr<Plan> plan = TryPlan(belief, request);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->chosen, -1);
  EXPECT_THAT(plan->explanation, Not(HasSubstr("home")));
}

TEST(StrategyReturn, ReturnsBeforeItIsComplete) {
  testing::GoalCase c(kClosed);
  c.AddGas(kClosed, 0.0F);
  c.belief.robots["r"].fruitless_fallbacks = 2;
  c.belief.robots["r"].first_place = c.belief.geometry().Center({6, 2});
  PlanningOptions options = testing::XitGff();
  options.return_home = true;
  absl::StatusOr<Plan> plan = TryPlan(c.belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->phase, MissionPhase::kReturning);
  EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kHome);
  const Point2 home = Chosen(*plan).goal.position;
  c.belief.robots["r"].state.pose = {home.x_m, home.y_m, 0.0};
  plan = TryPlan(c.belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->phase, MissionPhase::kComplete);
}

TEST(StrategyReturn, TakesOnlyGoalsWithinTheTravelBudget) {
  Belief belief = FromTheEast();
  PlanningOptions options = testing::XitGff();
  options.travel_budget_m = 1.4;  // enough for the east only, which is next to home
  absl::StatusOr<Plan> plan = TryPlan(belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->phase, MissionPhase::kExploring);
  EXPECT_EQ(Chosen(*plan).goal.cell.x, 14);
  ASSERT_THAT(plan->rejected, SizeIs(1));
  EXPECT_EQ(plan->rejected[0].reason, RejectionReason::kOverBudget);
  EXPECT_THAT(plan->rejected[0].detail, HasSubstr("of 1.4 m"));
}

TEST(StrategyReturn, DrivesHomeOnceEveryGoalIsOverBudgetAndIsThenComplete) {
  Belief belief = FromTheEast();
  belief.robots["r"].travelled_m = 100.0;
  PlanningOptions options = testing::XitGff();
  options.travel_budget_m = 101.0;
  absl::StatusOr<Plan> plan = TryPlan(belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->phase, MissionPhase::kReturning);
  EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kHome);
  EXPECT_THAT(plan->rejected, SizeIs(2));
  EXPECT_THAT(plan->explanation, HasSubstr("beyond the travel budget"));
  EXPECT_EQ(*plan, *TryPlan(belief, For("r"), options));

  const Point2 home = Chosen(*plan).goal.position;
  belief.robots["r"].state.pose = {home.x_m, home.y_m, 0.0};
  belief.robots["r"].travelled_m = 101.0;
  plan = TryPlan(belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->phase, MissionPhase::kComplete);
  EXPECT_EQ(plan->end, PlanEnd::kMissionComplete);
  EXPECT_EQ(plan->chosen, -1);
  EXPECT_THAT(plan->explanation, HasSubstr("travel budget"));
}

TEST(StrategyReturn, StartsWhereTheLivePlanWillHaveTheRobot) {
  Belief belief = SmallBelief(kRoom);
  const Pose2 pose = belief.robots["r"].state.pose;
  Trajectory live;  // to the west at 0.1 m/s
  live.waypoints = {{{pose.x_m, pose.y_m, M_PI}, 0.0, 0.0},
                    {{pose.x_m - 0.2, pose.y_m, M_PI}, 2.0, 0.0}};
  belief.robots["r"].live_trajectory = std::make_shared<const Trajectory>(live);
  PlanningOptions options = testing::XitGff();
  options.planning_latency_s = 1.0;
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_NEAR(Chosen(*plan).path.front().x_m, pose.x_m - 0.1, kRounding);
}

PlanningOptions RandomLimits(Rng& rng) {
  PlanningOptions options = testing::XitGff();
  options.travel_budget_m = rng.Uniform(20.0, 60.0);
  options.return_margin_share = rng.Uniform(0.0, 1.0);
  options.return_home = rng.Below(2) == 0;
  options.max_acceleration_mps2 = rng.Below(2) == 0 ? 0.0 : rng.Uniform(0.1, 2.0);
  options.max_turn_rate_rad_per_s = rng.Below(2) == 0 ? 0.0 : rng.Uniform(0.1, 2.0);
  options.dwell_s = rng.Below(2) == 0 ? 0.0 : 3.0;
  return options;
}

void ExpectTimesInOrder(const Trajectory& trajectory, double speed_mps) {
  double before_s = 0.0;
  for (const Waypoint& waypoint : trajectory.waypoints) {
    EXPECT_GE(waypoint.arrival_time_s, before_s);
    EXPECT_LE(waypoint.speed_mps, speed_mps * (1.0 + kRounding));
    before_s = waypoint.arrival_time_s + waypoint.dwell_s;
  }
  EXPECT_TRUE(std::isfinite(trajectory.duration_s));
  EXPECT_EQ(trajectory.duration_s, before_s);
}

TEST(StrategyReturn, KeepsItsWordUnderRandomOptionsInRandomHalls) {
  Rng rng(77);
  for (int seed = 1; seed <= support::Rounds(8); ++seed) {
    lab::RandomWorld world = lab::MakeRandomWorld(seed, 1);
    RobotRecord& robot = world.belief.robots[world.robot];
    robot.first_place = Point2{rng.Uniform(-2.0, 18.0), rng.Uniform(-2.0, 22.0)};
    robot.travelled_m = rng.Uniform(0.0, 30.0);
    const PlanningOptions options = RandomLimits(rng);
    PlanRequest request = For(world.robot, seed);
    request.go_home = rng.Below(4) == 0;
    const absl::StatusOr<Plan> plan = TryPlan(world.belief, request, options);
    ASSERT_TRUE(plan.ok()) << plan.status();
    EXPECT_FALSE(plan->explanation.empty());
    const double left_m = options.travel_budget_m - robot.travelled_m;
    for (const Candidate& candidate : plan->candidates) {
      if (candidate.goal.kind == GoalKind::kHome) continue;
      EXPECT_FALSE(request.go_home);
      // No way home is shorter than the straight one to where the robot can stand near it.
      const double back_m = Distance_m(candidate.goal.position, *robot.first_place) - 1.3;
      EXPECT_LE(candidate.length_m + (1.0 + options.return_margin_share) * back_m, left_m);
    }
    EXPECT_TRUE(plan->chosen >= 0 || plan->trajectory.waypoints.empty());
    ExpectTimesInOrder(plan->trajectory, options.speed_mps);
  }
}

// The centre of the cell that the robot can reach by the longest way.
Point2 FarthestPlace(const Belief& belief, const RobotId& robot) {
  const Cell start = belief.geometry().CellAt(belief.robots.at(robot).state.pose.position());
  const Grid<double> travel_m = TravelDistances_m(*belief.traversable, std::vector<Cell>{start});
  std::size_t farthest = belief.geometry().Index(start);
  for (std::size_t i = 0; i < travel_m.size(); ++i) {
    if (std::isfinite(travel_m[i]) && travel_m[i] > travel_m[farthest]) farthest = i;
  }
  return belief.geometry().Center(belief.geometry().CellAtIndex(farthest));
}

TEST(StrategyReturn, OutOfWorkOnTheWayHomeDoesNotClaimToBeThere) {
  const lab::RandomWorld world = lab::MakeRandomWorld(2, 3);
  Belief belief = world.belief;
  PlanRequest request = For(world.robot, 4);
  request.go_home = true;
  request.max_edge_evaluations = 1;
  MissionOptions mission = *belief.options;
  mission.home = FarthestPlace(belief, world.robot);
  belief.options = std::make_shared<const MissionOptions>(mission);
  const absl::StatusOr<Plan> plan = TryPlan(belief, request);
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(plan->end, PlanEnd::kStopped);
  EXPECT_EQ(plan->chosen, -1);
  EXPECT_THAT(plan->explanation, HasSubstr("stopped"));
}

Belief WithObjective(Belief belief, ObjectiveState state, double deadline_s = 0.0) {
  MissionOptions options = *belief.options;
  options.objective = {
      .kind = ObjectiveKind::kConfirmClean, .threshold_ppm = 10.0, .deadline_s = deadline_s};
  belief.options = std::make_shared<const MissionOptions>(options);
  belief.objective = ObjectiveStatus{.state = state, .confidence = 0.96};
  return belief;
}

TEST(StrategyReturn, AnObjectiveThatIsMetEndsTheMissionOnTheSpot) {
  const absl::StatusOr<Plan> plan =
      TryPlan(WithObjective(FromTheEast(), ObjectiveState::kMet), For("r"));
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(plan->end, PlanEnd::kMissionComplete);
  EXPECT_EQ(plan->phase, MissionPhase::kComplete);
  EXPECT_EQ(plan->explanation,
            "Stay: the mission is complete. The objective is met: clean: nowhere more than 10 ppm, "
            "with a confidence of 96 %.");
}

TEST(StrategyReturn, AnObjectiveThatIsRefutedSendsRobotsHomeWhereMissionsEndThere) {
  PlanningOptions options = testing::XitGff();
  options.return_home = true;
  const Belief belief = WithObjective(FromTheEast(), ObjectiveState::kRefuted);
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r"), options);
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kHome);
  EXPECT_THAT(plan->explanation, HasSubstr("The objective is refuted"));
}

TEST(StrategyReturn, WhoWouldBeLateForEveryGoalGoesHome) {
  Belief belief = WithObjective(FromTheEast(), ObjectiveState::kPursued, 10.0);
  belief.deadline_ns = belief.sample_time_ns + 900'000'000;
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r"));
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kHome);
  EXPECT_THAT(plan->explanation, HasSubstr("home after the deadline"));
}

TEST(StrategyReturn, WhoIsHomeByTheDeadlineIsDone) {
  Belief belief = WithObjective(FromTheEast(), ObjectiveState::kPursued, 10.0);
  belief.robots["r"].first_place = belief.robots["r"].state.pose.position();
  belief.deadline_ns = belief.sample_time_ns;
  const absl::StatusOr<Plan> plan = TryPlan(belief, For("r"));
  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_EQ(plan->end, PlanEnd::kMissionComplete);
  EXPECT_THAT(plan->explanation, HasSubstr("The deadline, 10 s from the first observation"));
}

}  // namespace composed_strategy_return_test
}  // namespace plumescout
