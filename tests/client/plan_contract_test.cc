// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Plans and what is reported of them.
#include "tests/client/planner_client_contract.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "client/error_reason.h"

namespace plumescout::client {
namespace plan_contract_test {

using ::testing::IsEmpty;
using ::testing::Not;

class PlanContract : public PlannerClientContract {};

TEST_P(PlanContract, ARobotWithoutAPoseCannotBePlannedFor) {
  const RobotSession session = Register();

  const absl::Status status = client().NextBestTrajectory("house", Query(session)).status();

  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
}

TEST_P(PlanContract, AnUnknownRobotCannotBePlannedFor) {
  RobotSession stranger;
  stranger.robot = "stranger";
  stranger.lease_token = 1;

  EXPECT_TRUE(absl::IsNotFound(client().NextBestTrajectory("house", Query(stranger)).status()));
}

TEST_P(PlanContract, AfterALookAroundThereIsATrajectoryFromTheRobot) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, LookAround(8)).ok());

  const absl::StatusOr<Plan> plan = client().NextBestTrajectory("house", Query(session, 8));

  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_GT(plan->id, 0);
  EXPECT_EQ(plan->robot, "scout");
  EXPECT_GE(plan->belief_revision, 8);
  EXPECT_THAT(plan->explanation, Not(IsEmpty()));
  if (plan->chosen >= 0) {
    ASSERT_THAT(plan->trajectory.waypoints, Not(IsEmpty()));
    const Point2 start = plan->trajectory.waypoints.front().pose.position();
    EXPECT_LT(Distance_m(start, {0.0, 0.0}), 0.15);  // a cell's diagonal
  }
}

TEST_P(PlanContract, TheSameSeedAndWorkGiveTheSamePlan) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, LookAround(8)).ok());
  PlanQuery query = Query(session, 8);
  query.request.seed = 5;
  query.request.max_edge_evaluations = 2000;
  query.budget = kPatience;

  absl::StatusOr<Plan> first = client().NextBestTrajectory("house", query);
  absl::StatusOr<Plan> second = client().NextBestTrajectory("house", query);

  ASSERT_TRUE(first.ok()) << first.status();
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_NE(first->id, second->id);
  EXPECT_EQ(first->candidates, second->candidates);
  EXPECT_EQ(first->trajectory, second->trajectory);
}

TEST_P(PlanContract, PlanningWaitsForTheRobotsOwnReadings) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, LookAround(8)).ok());

  // Before the call comes to wait or after: the answer is the same.
  std::thread sender([&] { EXPECT_EQ(stream->Write(GasRange(9, 12)), absl::OkStatus()); });
  const absl::StatusOr<Plan> plan = client().NextBestTrajectory("house", Query(session, 12));
  sender.join();

  ASSERT_TRUE(plan.ok()) << plan.status();
  EXPECT_GE(plan->belief_revision, 12);
}

TEST_P(PlanContract, PlanningGivesUpOnReadingsThatNeverCome) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, LookAround(8)).ok());
  PlanQuery query = Query(session, 100);
  query.timeout = absl::Milliseconds(100);

  const absl::Status status = client().NextBestTrajectory("house", query).status();

  EXPECT_TRUE(absl::IsDeadlineExceeded(status)) << status;
}

TEST_P(PlanContract, PlanningEndsWhenAnotherTakesTheLease) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, LookAround(8)).ok());

  // Before the call comes to wait or after: the answer is the same.
  std::thread rival([&] {
    EXPECT_TRUE(client().RegisterRobot("house", session.robot, kRadius_m, /*take_over=*/true).ok());
  });
  const absl::Status status = client().NextBestTrajectory("house", Query(session, 100)).status();
  rival.join();

  EXPECT_EQ(ErrorReason(status), kLeaseSuperseded) << status;
}

TEST_P(PlanContract, ProgressIsReportedOfKnownPlansOnly) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, LookAround(8)).ok());
  const absl::StatusOr<Plan> plan = client().NextBestTrajectory("house", Query(session, 8));
  ASSERT_TRUE(plan.ok()) << plan.status();

  EXPECT_FALSE(client().ReportProgress(session, plan->id + 7, ProgressOutcome::kReached).ok());
  EXPECT_EQ(client().ReportProgress(session, plan->id, ProgressOutcome::kReached),
            absl::OkStatus());
}

TEST_P(PlanContract, AReportMadeTwiceIsNotAnError) {
  const RobotSession session = Register();
  const auto stream = Open(session);
  ASSERT_TRUE(SendAll(*stream, LookAround(8)).ok());
  const absl::StatusOr<Plan> plan = client().NextBestTrajectory("house", Query(session, 8));
  ASSERT_TRUE(plan.ok()) << plan.status();
  ASSERT_TRUE(client().ReportProgress(session, plan->id, ProgressOutcome::kBlocked).ok());

  EXPECT_EQ(client().ReportProgress(session, plan->id, ProgressOutcome::kBlocked),
            absl::OkStatus());
}

INSTANTIATE_TEST_SUITE_P(All, PlanContract, ::testing::ValuesIn(AllBackends()), BackendName);

}  // namespace plan_contract_test
}  // namespace plumescout::client
