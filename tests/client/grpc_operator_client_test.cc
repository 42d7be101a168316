// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_operator_client.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "client/grpc_planner_client.h"
#include "client/grpc_viewer_client.h"
#include "core/plan/trajectory_timing.h"
#include "core/types/error_reason.h"
#include "server/server.h"
#include "tests/client/ingest_traffic.h"
#include "tests/server/host_parts.h"

namespace plumescout::client {
namespace grpc_operator_client_test {

constexpr std::int64_t kHour_ns = 3'600'000'000'000;

// From where the robot is to 2 m north of the mission's origin, or 2 m south.
absl::StatusOr<Plan> DriveApart(const Belief& belief, const PlanRequest& request, const StopFn&) {
  const double y_m = request.robot == "north" ? 2.0 : -2.0;
  Plan plan = server::PlanTo(belief, request.robot, 0.0);
  plan.candidates[0].goal.position = {0.0, y_m};
  plan.candidates[0].path = {belief.robots.at(request.robot).state.pose.position(), {0.0, y_m}};
  plan.trajectory = TimeTrajectory(plan.candidates[0].path, 0.0, PlanningOptions());
  return plan;
}

// A server with a mission, "house", whose operator and robots are on connections of their own.
class GrpcOperatorClientTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server::ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.planning.max_budget_s = 60.0;  // enough on any machine
    auto started = server::Server::Start(config, server::ScriptedHooks(DriveApart));
    ASSERT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
    const GrpcClientOptions options{.target = absl::StrCat("127.0.0.1:", server_->port()),
                                    .call_timeout = kPatience};
    robots_ = MakeGrpcPlannerClient(options);
    const auto link = MakeGrpcLink(options);
    operator_ = MakeGrpcOperatorClient(link);
    viewer_ = MakeGrpcViewerClient(link);
    ASSERT_EQ(robots_->CreateMission("house", {}), absl::OkStatus());
  }
  RobotSession Register(const RobotId& robot, const RobotOutfit& outfit = {}) {
    auto session = robots_->RegisterRobot("house", robot, 0.2, false, 0, outfit);
    EXPECT_TRUE(session.ok()) << session.status();
    return session.ok() ? *session : RobotSession{};
  }
  // A stream on which a reading was sent, taken at (0, y).
  std::unique_ptr<ObservationStream> SendGas(const RobotSession& session, double y_m = 0.0) {
    auto stream = robots_->OpenObservationStream(session);
    EXPECT_TRUE(stream.ok()) << stream.status();
    if (!stream.ok()) return nullptr;
    Observation reading = GasAt(1);
    reading.pose = {0.0, y_m, 0.0};
    if (session.robot_clock_ns) reading.sample_time_ns = session.robot_clock_ns();
    const auto replies = SendAll(**stream, {reading});
    EXPECT_TRUE(replies.ok()) << replies.status();
    return *std::move(stream);
  }
  RobotDetails Get(const RobotId& robot) {
    auto details = viewer_->GetRobot("house", robot);
    EXPECT_TRUE(details.ok()) << details.status();
    return details.ok() ? *std::move(details) : RobotDetails{};
  }
  // Reads notices until the robot stands so; false if the watch ends before.
  static bool AwaitStanding(RobotWatch& watch,
                            const std::function<bool(const RobotStanding&)>& so) {
    while (true) {
      const auto notice = watch.Read(kPatience);
      EXPECT_TRUE(notice.ok()) << notice.status();
      if (!notice.ok()) return false;
      const auto* standing = std::get_if<RobotStanding>(&*notice);
      if (standing != nullptr && so(*standing)) return true;
    }
  }

  std::unique_ptr<server::Server> server_;
  std::unique_ptr<PlannerClient> robots_;
  std::unique_ptr<OperatorClient> operator_;
  std::unique_ptr<ViewerClient> viewer_;
};

TEST_F(GrpcOperatorClientTest, ARobotIsToldWithItsLinkItsFrameAndItsClock) {
  RobotOutfit outfit;
  outfit.frame = {.mission_from_robot = {1.0, 2.0, 0.5},
                  .position_stddev_m = 0.125,
                  .heading_stddev_rad = 0.0625};
  RobotSession session = Register("scout", outfit);
  RobotDetails details = Get("scout");
  EXPECT_EQ(details.state.id, "scout");
  EXPECT_EQ(details.link, RobotLink::kIdle);
  EXPECT_TRUE(details.leased);
  EXPECT_FALSE(details.state.has_pose);
  EXPECT_EQ(details.state.frame, outfit.frame);
  EXPECT_EQ(details.clock_offset_ns, std::nullopt);
  EXPECT_EQ(details.last_heard_age_s, std::nullopt);
  EXPECT_EQ(details.ingest_lag_s, std::nullopt);
  EXPECT_EQ(details.live_plan, std::nullopt);

  session.robot_clock_ns = [] { return absl::ToUnixNanos(absl::Now()) + kHour_ns; };
  const auto stream = SendGas(session);
  details = Get("scout");
  EXPECT_EQ(details.link, RobotLink::kStreaming);
  EXPECT_EQ(details.state.applied_sequence, 1);
  EXPECT_TRUE(details.state.has_pose);
  EXPECT_NEAR(details.state.pose.x_m, 1.0, 1e-12) << "in the mission's frame";
  EXPECT_NEAR(static_cast<double>(details.state.clock_offset_ns), -static_cast<double>(kHour_ns),
              1e9 * absl::ToDoubleSeconds(kPatience));
  EXPECT_EQ(details.clock_offset_ns, details.state.clock_offset_ns);
  EXPECT_TRUE(details.last_heard_age_s.has_value());
  EXPECT_TRUE(details.ingest_lag_s.has_value());
}

TEST_F(GrpcOperatorClientTest, RobotsAreListedByName) {
  for (const char* robot : {"b", "a", "c"}) Register(robot);
  const auto robots = viewer_->ListRobots("house");
  ASSERT_TRUE(robots.ok()) << robots.status();
  std::vector<RobotId> names;
  for (const RobotDetails& robot : *robots) names.push_back(robot.state.id);
  EXPECT_EQ(names, (std::vector<RobotId>{"a", "b", "c"}));
}

TEST_F(GrpcOperatorClientTest, WhatIsNotThereIsNotFound) {
  EXPECT_EQ(ErrorReason(viewer_->GetRobot("house", "r9").status()), reason::kRobotNotFound);
  EXPECT_EQ(ErrorReason(viewer_->ListRobots("attic").status()), reason::kMissionNotFound);
  EXPECT_EQ(ErrorReason(operator_->RemoveRobot("house", "r9")), reason::kRobotNotFound);
  EXPECT_EQ(ErrorReason(operator_->ReleaseLease("house", "r9")), reason::kRobotNotFound);
  EXPECT_EQ(ErrorReason(operator_->OrderHome("house", "r9", true)), reason::kRobotNotFound);
  EXPECT_EQ(ErrorReason(operator_->PlanTeam("attic", {}).status()), reason::kMissionNotFound);
  const auto watch = operator_->WatchRobot("house", "r9");
  ASSERT_TRUE(watch.ok());
  EXPECT_EQ(ErrorReason((*watch)->Read(kPatience).status()), reason::kRobotNotFound);
}

TEST_F(GrpcOperatorClientTest, ATeamIsPlannedForAndItsRobotsFetchTheirPlans) {
  const RobotSession north = Register("north");
  const RobotSession south = Register("south");
  SendGas(north, 1.0);
  SendGas(south, -1.0);
  const auto team = operator_->PlanTeam("house", {.timeout = kPatience});
  ASSERT_TRUE(team.ok()) << team.status();
  ASSERT_EQ(team->plans.size(), 2U);
  EXPECT_TRUE(team->left_out.empty());
  EXPECT_GE(team->order_count, 1);
  const auto mine = std::find_if(team->plans.begin(), team->plans.end(),
                                 [](const Plan& plan) { return plan.robot == "north"; });
  ASSERT_NE(mine, team->plans.end());
  EXPECT_EQ(mine->candidates.at(0).goal.position, (Point2{0.0, 2.0}));
  PlanQuery query;
  query.request.robot = "north";
  query.lease_token = north.lease_token;
  query.timeout = kPatience;
  const auto fetched = robots_->NextBestTrajectory("house", query);
  ASSERT_TRUE(fetched.ok()) << fetched.status();
  EXPECT_EQ(fetched->id, mine->id);
  const RobotDetails details = Get("north");
  ASSERT_TRUE(details.live_plan.has_value());
  EXPECT_EQ(details.live_plan->plan, mine->id);

  const auto nobody = operator_->PlanTeam("house", {.timeout = kPatience});
  ASSERT_TRUE(nobody.ok()) << nobody.status();
  EXPECT_TRUE(nobody->plans.empty()) << "nobody is free";
  const auto again = operator_->PlanTeam("house", {.robots = {"south"}, .timeout = kPatience});
  ASSERT_TRUE(again.ok()) << again.status();
  ASSERT_EQ(again->plans.size(), 1U) << "who is named gets another";
  EXPECT_EQ(again->plans[0].robot, "south");
}

TEST_F(GrpcOperatorClientTest, OneRobotOrAllAreSentHomeAndBack) {
  Register("a");
  Register("b");
  ASSERT_EQ(operator_->OrderHome("house", "a", true), absl::OkStatus());
  EXPECT_TRUE(Get("a").state.ordered_home);
  EXPECT_FALSE(Get("b").state.ordered_home);
  ASSERT_EQ(operator_->OrderHome("house", std::nullopt, true), absl::OkStatus());
  EXPECT_TRUE(Get("b").state.ordered_home);
  ASSERT_EQ(operator_->OrderHome("house", std::nullopt, false), absl::OkStatus());
  EXPECT_FALSE(Get("a").state.ordered_home);
}

TEST_F(GrpcOperatorClientTest, WhoWatchesHearsOfAPauseAndOfTheEnd) {
  Register("scout");
  auto watch = operator_->WatchRobot("house", "scout");
  ASSERT_TRUE(watch.ok()) << watch.status();
  const auto runs = [](const RobotStanding& standing) { return !standing.paused; };
  const auto rests = [](const RobotStanding& standing) { return standing.paused; };
  const auto is_over = [](const RobotStanding& standing) { return standing.finished; };
  EXPECT_TRUE(AwaitStanding(**watch, runs));
  ASSERT_EQ(operator_->PauseMission("house"), absl::OkStatus());
  EXPECT_TRUE(AwaitStanding(**watch, rests));
  EXPECT_EQ(ErrorReason(operator_->PlanTeam("house", {}).status()), reason::kMissionPaused);
  ASSERT_EQ(operator_->ResumeMission("house"), absl::OkStatus());
  EXPECT_TRUE(AwaitStanding(**watch, runs));
  ASSERT_EQ(operator_->FinishMission("house"), absl::OkStatus());
  EXPECT_TRUE(AwaitStanding(**watch, is_over));
}

TEST_F(GrpcOperatorClientTest, ALeaseIsFreedAndARobotRemovedWhoeverHoldsIt) {
  const RobotSession first = Register("scout");
  EXPECT_EQ(ErrorReason(robots_->RegisterRobot("house", "scout", 0.2, false).status()),
            reason::kLeaseHeld);
  ASSERT_EQ(operator_->ReleaseLease("house", "scout"), absl::OkStatus());
  EXPECT_EQ(Get("scout").link, RobotLink::kGone);
  EXPECT_GT(Register("scout").lease_token, first.lease_token);
  ASSERT_EQ(operator_->RemoveRobot("house", "scout"), absl::OkStatus());
  EXPECT_TRUE(viewer_->ListRobots("house")->empty());
}

TEST_F(GrpcOperatorClientTest, HowAMissionIsKeptCanChange) {
  ASSERT_EQ(operator_->UpdateMission("house", {.idle_time_to_live = absl::Seconds(90)}),
            absl::OkStatus());
  EXPECT_EQ(viewer_->GetMission("house")->idle_time_to_live, absl::Seconds(90));
  ASSERT_EQ(operator_->UpdateMission("house", {.event_retention = EventRetention::kSinceSnapshot}),
            absl::OkStatus());
  EXPECT_EQ(viewer_->GetMission("house")->event_retention, EventRetention::kSinceSnapshot);
  EXPECT_EQ(viewer_->GetMission("house")->idle_time_to_live, absl::Seconds(90)) << "as it was";
  ASSERT_EQ(operator_->UpdateMission("house", {.idle_time_to_live = absl::InfiniteDuration()}),
            absl::OkStatus());
  EXPECT_EQ(viewer_->GetMission("house")->idle_time_to_live, absl::InfiniteDuration());
  EXPECT_TRUE(absl::IsInvalidArgument(operator_->UpdateMission("house", {}))) << "nothing changes";
}

TEST_F(GrpcOperatorClientTest, AreasAreClosedAndOpened) {
  const Polygon spill{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}, "spill"};
  const auto closed = operator_->ChangeKeepOutAreas("house", {{}, {spill}});
  ASSERT_TRUE(closed.ok()) << closed.status();
  EXPECT_EQ(*closed, std::vector<Polygon>{spill});
  EXPECT_EQ(ErrorReason(operator_->ChangeKeepOutAreas("house", {{}, {spill}}).status()),
            reason::kKeepOutAreaExists);
  EXPECT_TRUE(operator_->ChangeKeepOutAreas("house", {{"spill"}, {}})->empty());
}

}  // namespace grpc_operator_client_test
}  // namespace plumescout::client
