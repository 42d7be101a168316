// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the planning service: whether ways still hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "proto/convert/geometry.h"
#include "server/services/planning_service.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace trajectory_check_test {

constexpr auto kNotFound = absl::StatusCode::kNotFound;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;

class TrajectoryCheckTest : public ServiceTest {
 protected:
  // A server with a robot that has seen a room.
  void Start(ScriptedStrategy::Script script = nullptr) {
    StartServer({}, script == nullptr ? RegistryHooks{} : ScriptedHooks(std::move(script)));
    lease_ = Lease();
    for (int i = 1; i <= 4; ++i) ASSERT_TRUE(Ingest(kRobot, lease_, RoomScan(i)).ok());
  }
  v1::NextBestTrajectoryRequest Order() const { return PlanFor(lease_); }
  v1::CheckTrajectoryRequest CheckOrder() const {
    v1::CheckTrajectoryRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease_);
    return request;
  }
  absl::StatusOr<v1::CheckTrajectoryResponse> CheckPlan(std::int64_t plan) {
    v1::CheckTrajectoryRequest request = CheckOrder();
    request.set_plan(absl::StrCat("missions/hall/plans/", plan));
    return Call(planning_, &v1::PlanningService::Stub::CheckTrajectory, request);
  }

  std::int64_t lease_ = 0;
};

absl::StatusOr<Plan> DriveEast(const Belief& belief, const PlanRequest& request, const StopFn&) {
  return PlanTo(belief, request.robot, 1.0);
}

TEST_F(TrajectoryCheckTest, APlanJustMadeStillHolds) {
  Start();
  const auto planned = NextBest(Order());
  ASSERT_TRUE(planned.ok()) << planned.status();
  const v1::Plan& plan = planned->plan();
  const auto check = CheckPlan(1);
  ASSERT_TRUE(check.ok()) << check.status();
  EXPECT_FALSE(check->has_blockage());
  EXPECT_FALSE(check->has_rejected_goal()) << check->rejected_goal().detail();
  EXPECT_NEAR(check->rest().length_m(), plan.trajectory().length_m(), 1e-9);
  EXPECT_NEAR(check->rest().cost(), plan.candidates(plan.chosen_index()).cost(), 1e-9);
  EXPECT_EQ(check->revision(), Revision());
}

TEST_F(TrajectoryCheckTest, APathIntoTheDarkIsBlocked) {
  Start();
  const std::int64_t revision = Revision();
  v1::CheckTrajectoryRequest request = CheckOrder();
  *request.mutable_path()->add_vertices() = ToProto(Point2{2.0, 1.5});
  *request.mutable_path()->add_vertices() = ToProto(Point2{900.0, 1.5});
  request.mutable_path()->set_goal_kind(v1::GOAL_KIND_OCCUPANCY_FRONTIER);
  const auto check = Call(planning_, &v1::PlanningService::Stub::CheckTrajectory, request);
  ASSERT_TRUE(check.ok()) << check.status();
  ASSERT_TRUE(check->has_blockage());
  EXPECT_GT(check->blockage().distance_m(), 1.0);
  EXPECT_NEAR(check->blockage().position().x_m(), 2.0 + check->blockage().distance_m(), 1e-9);
  EXPECT_EQ(check->rejected_goal().reason(), v1::RejectedGoal::REASON_GONE);
  EXPECT_FALSE(check->has_rest());
  EXPECT_EQ(Revision(), revision) << "a question changes nothing";
}

TEST_F(TrajectoryCheckTest, OperatorsCheckWaysWithoutALease) {
  Start();
  v1::CheckTrajectoryRequest request = CheckOrder();
  request.clear_lease_token();
  *request.mutable_path()->add_vertices() = ToProto(Point2{2.0, 1.5});
  request.mutable_path()->set_goal_kind(v1::GOAL_KIND_RANDOM_FREE_SPACE);
  const auto check = Call(planning_, &v1::PlanningService::Stub::CheckTrajectory, request);
  ASSERT_TRUE(check.ok()) << check.status();
  EXPECT_EQ(check->revision(), Revision());
  request.set_robot("missions/hall/robots/nobody");
  EXPECT_THAT(Call(planning_, &v1::PlanningService::Stub::CheckTrajectory, request).status(),
              Refuses(absl::StatusCode::kNotFound, "ROBOT_NOT_FOUND"));
}

TEST_F(TrajectoryCheckTest, ChecksOfOtherPlansAreRefused) {
  Start(DriveEast);
  EXPECT_THAT(CheckPlan(1).status(), Refuses(kNotFound, "NOT_FOUND"));
  ASSERT_TRUE(NextBest(Order()).ok());
  EXPECT_THAT(CheckPlan(1).status(), Refuses(kPrecondition, "PLAN_ENDED")) << "it has no waypoints";
  ASSERT_TRUE(NextBest(Order()).ok());
  EXPECT_THAT(CheckPlan(1).status(), Refuses(kPrecondition, "PLAN_SUPERSEDED"));
}

}  // namespace trajectory_check_test
}  // namespace plumescout::server
