// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/robot_loop.h"
#include "tests/client/robot_loop_fixture.h"

namespace plumescout::client {
namespace robot_loop_legs_test {

using ::testing::ElementsAre;
using ::testing::Field;

using RobotLoopLegsTest = RobotLoopTest;

TEST_F(RobotLoopLegsTest, AnObstacleOnThePathIsReportedAndPlannedAround) {
  driver_.posts = {{2.0, 0.0}};
  server_.set_script(Tour({{4, 0}, {0, 2}}));

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->blocked, 1);
  EXPECT_EQ(result->reached, 1);
  EXPECT_THAT(server_.reports(),
              ElementsAre(Field(&FakePlannerClient::Report::outcome, ProgressOutcome::kBlocked),
                          Field(&FakePlannerClient::Report::outcome, ProgressOutcome::kReached)));
}

TEST_F(RobotLoopLegsTest, ARobotThatCannotMoveIsBlocked) {
  for (const Following following : {Following::kIdeal, Following::kProportional}) {
    server_.set_script(Tour({{1, 0}}));
    const std::int64_t start_ns = driver_.now_ns();
    driver_.place_status = absl::UnavailableError("something is in the way");
    driver_.on_advance = [this] {  // poses err
      driver_.set_pose({0.0, driver_.pose().y_m < 0.01 ? 0.05 : 0.0, 0.0});
    };

    const absl::StatusOr<RobotResult> result = Run(Options(Pacing::kLockstep, following));

    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result->blocked, 1);
    EXPECT_LT(static_cast<double>(driver_.now_ns() - start_ns) * 1e-9, 5.0);
    EXPECT_EQ(result->end, RobotEnd::kMissionComplete);
  }
}

TEST_F(RobotLoopLegsTest, ItIsNotTheGoalsFaultIfARobotIsStuckAgain) {
  server_.set_script(Tour({{1, 0}, {0, 1}, {-1, 0}}));
  driver_.place_status = absl::UnavailableError("something is in the way");

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->blocked, 1);
  EXPECT_EQ(result->aborted, 2);
}

TEST_F(RobotLoopLegsTest, ARobotThatOnlyTurnsGivesThePlanUp) {
  server_.set_script(Tour({{1, 0}}));
  driver_.on_advance = [this] { driver_.set_pose({0.0, 0.0, driver_.pose().yaw_rad + 0.3}); };

  const absl::StatusOr<RobotResult> result =
      Run(Options(Pacing::kLockstep, Following::kProportional));

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->aborted, 1);
  EXPECT_EQ(result->end, RobotEnd::kMissionComplete);
}

TEST_F(RobotLoopLegsTest, ARobotThatWaitsByPlanIsNotBlocked) {
  server_.set_script([tour = Tour({{1, 0}})](const PlanQuery& query) -> absl::StatusOr<Plan> {
    absl::StatusOr<Plan> plan = tour(query);
    if (plan.ok() && !plan->trajectory.waypoints.empty()) {
      plan->trajectory.waypoints[0].dwell_s = 6.0;
      plan->trajectory.waypoints[1].arrival_time_s += 6.0;
      plan->trajectory.duration_s += 6.0;
    }
    return plan;
  });
  const absl::StatusOr<RobotResult> result = RunInLockstep();
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->reached, 1);
  EXPECT_EQ(result->blocked, 0);
}

TEST_F(RobotLoopLegsTest, OnItsWayARobotAsksForABetterPlanAndGoesOn) {
  for (const Pacing pacing : {Pacing::kLockstep, Pacing::kFreeRunning}) {
    std::vector<Pose2> starts;
    const auto tour = Tour({{2, 0}, {2, 1}});
    server_.set_script([&](const PlanQuery& query) {
      starts.push_back(*query.request.start);
      return tour(query);
    });
    const std::size_t before = server_.reports().size();
    driver_.set_pose({});
    RobotLoopOptions options = Options(pacing, Following::kIdeal);
    options.replan_period_s = 0.6;

    const absl::StatusOr<RobotResult> result = Run(options);

    ASSERT_TRUE(result.ok()) << result.status();
    if (pacing == Pacing::kLockstep) {  // else a leg may end before the answer comes
      EXPECT_EQ(result->replaced, 2) << "the second by the end of the mission";
    }
    ASSERT_EQ(starts.size(), 3u);
    EXPECT_GT(starts[1].x_m, 0.2);
    EXPECT_LT(starts[1].x_m, 2.0);
    EXPECT_EQ(starts[1].y_m, 0.0);
    EXPECT_EQ(server_.reports().size(), before) << "of plans that others took the place of";
  }
}

TEST_F(RobotLoopLegsTest, ItAsksOnItsWayWhenThePlanAdvisesItUnlessToldOtherwise) {
  const auto tour = Tour({{2, 0}, {2, 1}});
  server_.set_script([&](const PlanQuery& query) -> absl::StatusOr<Plan> {
    auto plan = tour(query);
    if (plan.ok()) plan->replan_after_s = 0.6;
    return plan;
  });
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  absl::StatusOr<RobotResult> result = Run(options);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->replaced, 2);

  driver_.set_pose({});
  server_.set_script([&, again = Tour({{2, 0}, {2, 1}})](const PlanQuery& query) mutable {
    auto plan = again(query);
    if (plan.ok()) plan->replan_after_s = 0.6;
    return plan;
  });
  options.replan_period_s = 0.0;
  result = Run(options);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->replaced, 0);
}

TEST_F(RobotLoopLegsTest, WhoIsToStayOnItsWayStandsStill) {
  int asked = 0;
  const auto tour = Tour({{2, 0}});
  server_.set_script([&](const PlanQuery& query) -> absl::StatusOr<Plan> {
    ++asked;
    if (asked == 2) return Plan{};
    return asked == 1 ? tour(query) : CompletePlan();
  });
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.replan_period_s = 0.6;
  const absl::StatusOr<RobotResult> result = Run(options);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->replaced, 1);
  EXPECT_LT(result->distance_m, 2.0);
}

TEST_F(RobotLoopLegsTest, WithNowhereToGoItStandsAndAsksAgain) {
  int asked = 0;
  server_.set_script([&asked](const PlanQuery&) -> absl::StatusOr<Plan> {
    return ++asked < 4 ? Plan{} : CompletePlan();
  });

  const absl::StatusOr<RobotResult> result = RunInLockstep();

  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->plans, 4);
  EXPECT_NEAR(result->elapsed_s, 0.5 + 4 * 0.1 + 3 * 1.0, 1e-6);
  EXPECT_EQ(result->distance_m, 0.0);
}

// Its frame lies at (10, 5) of the mission, turned by a quarter: where it holds itself to be at
// (x, y), the mission has it at (10 - y, 5 + x).
TEST_F(RobotLoopLegsTest, ARobotWorksInItsOwnFrameAndAsksInTheMissions) {
  std::vector<Pose2> starts;
  const auto tour = Tour({{10, 7}, {9, 7}});
  server_.set_script([&](const PlanQuery& query) {
    starts.push_back(*query.request.start);
    return tour(query);
  });
  RobotLoopOptions options = Options(Pacing::kLockstep, Following::kIdeal);
  options.participation.frame.mission_from_robot = {10.0, 5.0, M_PI / 2};

  const absl::StatusOr<RobotResult> result = Run(options);

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->reached, 2);
  EXPECT_NEAR(driver_.pose().x_m, 2.0, 0.05);
  EXPECT_NEAR(driver_.pose().y_m, 1.0, 0.05);
  ASSERT_EQ(starts.size(), 3U);
  EXPECT_NEAR(starts[0].x_m, 10.0, 1e-9);
  EXPECT_NEAR(starts[0].y_m, 5.0, 1e-9);
  EXPECT_NEAR(starts[2].x_m, 9.0, 0.05);
  EXPECT_NEAR(starts[2].y_m, 7.0, 0.05);
  for (const Observation& observation : server_.received()) {
    EXPECT_LT(std::abs(observation.pose.y_m), 1.5) << "sent as the robot has it";
  }
  EXPECT_EQ(server_.registrations().back().outfit.frame, options.participation.frame);
}

}  // namespace robot_loop_legs_test
}  // namespace plumescout::client
