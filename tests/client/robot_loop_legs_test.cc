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

}  // namespace robot_loop_legs_test
}  // namespace plumescout::client
