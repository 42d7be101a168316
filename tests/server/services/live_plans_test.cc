// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the planning service: which plans are live, and how many there may be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/convert/geometry.h"
#include "server/services/planning_service.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace live_plans_test {

class LivePlansTest : public ServiceTest {
 protected:
  // A server with a robot that has seen a room.
  void Start(ServerConfig config = {}, ScriptedStrategy::Script script = nullptr) {
    StartServer(config, script == nullptr ? RegistryHooks{} : ScriptedHooks(std::move(script)));
    lease_ = Lease();
    for (int i = 1; i <= 4; ++i) ASSERT_TRUE(Ingest(kRobot, lease_, RoomScan(i)).ok());
  }
  v1::NextBestTrajectoryRequest Order() const { return PlanFor(lease_); }
  absl::StatusOr<v1::ReportProgressResponse> Report(std::int64_t plan) {
    v1::ReportProgressRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(lease_);
    request.set_plan(absl::StrCat("missions/hall/plans/", plan));
    request.set_outcome(v1::ReportProgressRequest::OUTCOME_REACHED);
    return Call(planning_, &v1::PlanningService::Stub::ReportProgress, request);
  }

  std::int64_t lease_ = 0;
};

absl::StatusOr<Plan> DriveEast(const Belief& belief, const PlanRequest& request, const StopFn&) {
  return PlanTo(belief, request.robot, 1.0);
}

TEST_F(LivePlansTest, LivePlansAreListedUntilTheyEnd) {
  Start();
  const auto live = [this] {
    v1::ListPlansRequest request;
    request.set_mission("missions/hall");
    return Call(planning_, &v1::PlanningService::Stub::ListPlans, request);
  };
  ASSERT_TRUE(live().ok()) << live().status();
  EXPECT_EQ(live()->plans_size(), 0);
  const auto planned = NextBest(Order());
  ASSERT_TRUE(planned.ok()) << planned.status();
  const v1::Plan& plan = planned->plan();
  const auto listed = live();
  ASSERT_EQ(listed->plans_size(), 1);
  EXPECT_EQ(listed->revision(), Revision());
  const v1::LivePlan& found = listed->plans(0);
  const v1::Goal& goal = plan.candidates(plan.chosen_index()).goal();
  EXPECT_EQ(found.name(), plan.name());
  EXPECT_EQ(found.robot(), kRobot);
  EXPECT_EQ(found.goal_kind(), goal.kind());
  EXPECT_EQ(found.goal().SerializeAsString(), goal.position().SerializeAsString());
  const std::int64_t newest_ns = RoomScan(4).observations(0).sample_time_ns();
  EXPECT_NEAR(static_cast<double>(found.arrival_time_ns() - newest_ns) * 1e-9,
              plan.trajectory().duration_s(), 1e-6);
  EXPECT_EQ(found.trajectory().SerializeAsString(), plan.trajectory().SerializeAsString());
  ASSERT_TRUE(Report(1).ok());
  EXPECT_EQ(live()->plans_size(), 0);
}

TEST_F(LivePlansTest, LatestPlanIsToldWithItsReasonsAfterItHasEnded) {
  Start();
  const auto latest = [this] {
    v1::ListPlansRequest request;
    request.set_mission("missions/hall");
    request.set_with_latest(true);
    return Call(planning_, &v1::PlanningService::Stub::ListPlans, request);
  };
  ASSERT_TRUE(latest().ok()) << latest().status();
  EXPECT_EQ(latest()->latest_size(), 0);
  const auto planned = NextBest(Order());
  ASSERT_TRUE(planned.ok()) << planned.status();
  ASSERT_TRUE(Report(1).ok());
  const auto listed = latest();
  EXPECT_EQ(listed->plans_size(), 0);
  ASSERT_EQ(listed->latest_size(), 1);
  EXPECT_EQ(listed->latest(0).SerializeAsString(), planned->plan().SerializeAsString());
  v1::RemoveRobotRequest removal;
  removal.set_robot(kRobot);
  removal.set_force(true);
  ASSERT_TRUE(Call(robots_, &v1::RobotService::Stub::RemoveRobot, removal).ok());
  EXPECT_EQ(latest()->latest_size(), 0);
}

TEST_F(LivePlansTest, WhoAsksForTooManyPlansIsToldWhenToAskAgain) {
  ServerConfig config;
  config.limits.max_plans_per_s = 0.4;  // two at once
  Start(config, DriveEast);
  ASSERT_TRUE(NextBest(Order()).ok());
  ASSERT_TRUE(NextBest(Order()).ok());
  const absl::Status refused = NextBest(Order()).status();
  EXPECT_THAT(refused, Refuses(absl::StatusCode::kResourceExhausted, "RATE_EXCEEDED"));
  EXPECT_GT(RetryDelay(refused).value(), absl::ZeroDuration());
}

}  // namespace live_plans_test
}  // namespace plumescout::server
