// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What only this client does; what it shares with others is in the *_contract_test.cc.
#include "client/grpc_planner_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "proto/convert/status.h"
#include "server/server.h"
#include "tests/client/ingest_traffic.h"
#include "tests/server/host_parts.h"

namespace plumescout::client {
namespace grpc_planner_client_test {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::unique_ptr<server::Server> StartServer(int port, server::RegistryHooks hooks = {}) {
  server::ServerConfig config;
  config.listen = absl::StrCat("127.0.0.1:", port);
  config.planning.max_budget_s = 60.0;  // enough on any machine
  auto started = server::Server::Start(config, std::move(hooks));
  EXPECT_TRUE(started.ok()) << started.status();
  return started.ok() ? *std::move(started) : nullptr;
}

// A port at which nobody listens (any more).
int UnusedPort() {
  const auto server = StartServer(0);
  return server != nullptr ? server->port() : 0;
}

GrpcClientOptions At(int port) { return {.target = absl::StrCat("127.0.0.1:", port)}; }

class GrpcPlannerClientTest : public ::testing::Test {
 protected:
  void Start(server::RegistryHooks hooks = {}) {
    server_ = StartServer(0, std::move(hooks));
    ASSERT_NE(server_, nullptr);
    client_ = MakeGrpcPlannerClient(At(server_->port()));
    ASSERT_TRUE(client_->CreateMission("house", {}).ok());
    const auto session = client_->RegisterRobot("house", "scout", 0.2, false);
    ASSERT_TRUE(session.ok()) << session.status();
    session_ = *session;
  }
  PlanQuery Query() const {
    PlanQuery query;
    query.request.robot = "scout";
    query.lease_token = session_.lease_token;
    query.timeout = kPatience;
    return query;
  }

  std::unique_ptr<server::Server> server_;
  std::unique_ptr<PlannerClient> client_;
  RobotSession session_;
};

TEST_F(GrpcPlannerClientTest, AServerThatIsNotThereIsUnavailableWithinTheTimeout) {
  GrpcClientOptions options = At(UnusedPort());
  options.call_timeout = absl::Milliseconds(150);
  const auto client = MakeGrpcPlannerClient(options);

  const absl::Status status = client->ListMissions().status();

  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr(options.target));
  EXPECT_TRUE(IsRetriable(status));
}

TEST_F(GrpcPlannerClientTest, AStreamToAServerThatIsNotThereIsUnavailable) {
  const auto client = MakeGrpcPlannerClient(At(UnusedPort()));

  RobotSession session;
  session.mission = "house";
  session.robot = "scout";
  const absl::Status status = client->OpenObservationStream(session).status();

  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
}

TEST_F(GrpcPlannerClientTest, AStreamKeepsToWhatTheServerTakesInOneRequest) {
  server::ServerConfig config;
  config.listen = "127.0.0.1:0";
  config.limits.max_receive_bytes = 8192;
  auto started = server::Server::Start(config);
  ASSERT_TRUE(started.ok()) << started.status();
  server_ = *std::move(started);
  client_ = MakeGrpcPlannerClient(At(server_->port()));
  ASSERT_TRUE(client_->CreateMission("house", {}).ok());
  const auto session = client_->RegisterRobot("house", "scout", 0.2, false);
  ASSERT_TRUE(session.ok()) << session.status();
  const auto stream = client_->OpenObservationStream(*session);
  ASSERT_TRUE(stream.ok()) << stream.status();
  std::vector<Observation> batch = GasRange(1, 20);
  constexpr std::size_t kBeams = 1000;  // of 2 bytes each: 40 kB in all
  for (Observation& observation : batch) {
    observation.payload = Scan{0.0, 0.001, 20.0, std::vector<float>(kBeams, 3.0F)};
  }
  ASSERT_EQ((*stream)->Write(batch), absl::OkStatus());
  ASSERT_EQ((*stream)->Finish(), absl::OkStatus());
  const auto again = client_->OpenObservationStream(*session);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ((*again)->opened().applied_sequence, 20);
}

TEST_F(GrpcPlannerClientTest, CallsWaitForTheServerToComeUp) {
  const int port = UnusedPort();
  const auto client = MakeGrpcPlannerClient(
      {.target = absl::StrCat("127.0.0.1:", port), .call_timeout = kPatience});
  std::thread starter([&] {
    absl::SleepFor(absl::Milliseconds(50));
    server_ = StartServer(port);
  });

  const auto missions = client->ListMissions();
  starter.join();

  ASSERT_TRUE(missions.ok()) << missions.status();
  EXPECT_THAT(*missions, IsEmpty());
}

TEST_F(GrpcPlannerClientTest, ACallFindsARestartedServer) {
  Start();
  const int port = server_->port();
  server_.reset();
  server_ = StartServer(port);

  const auto missions = client_->ListMissions();

  ASSERT_TRUE(missions.ok()) << missions.status();
  EXPECT_THAT(*missions, IsEmpty());
}

TEST_F(GrpcPlannerClientTest, ErrorsComeWithTheServersReasonAndDetails) {
  Start();

  const absl::Status exists = client_->CreateMission("house", {});
  EXPECT_TRUE(absl::IsAlreadyExists(exists)) << exists;
  EXPECT_EQ(Reason(exists), ErrorReason(exists));

  const absl::Status held = client_->RegisterRobot("house", "scout", 0.2, false).status();
  EXPECT_EQ(Reason(held), kLeaseHeld);
  EXPECT_EQ(ErrorReason(held), kLeaseHeld);

  MissionOptions options;
  options.gas.prior_precision_per_ppm2 = -2.0;
  EXPECT_THAT(FieldViolations(client_->CreateMission("barn", options)),
              Contains(Field(&FieldViolation::field, HasSubstr("prior_precision_per_ppm2"))));
}

TEST_F(GrpcPlannerClientTest, MissionsAreMadeWithTheOptionsGiven) {
  Start();
  MissionOptions options;
  options.occupancy.resolution_m = 0.25;
  options.frontier.fixed_gas_threshold_ppm = 5.5;

  ASSERT_TRUE(client_->CreateMission("barn", options).ok());

  const auto map = client_->GetMap("barn");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->occupancy.geometry().resolution_m, 0.25);
  EXPECT_EQ(map->gas_threshold_ppm, 5.5);
}

TEST_F(GrpcPlannerClientTest, AQueryArrivesAsAskedAndThePlanAsMade) {
  std::optional<PlanRequest> asked;
  Start(server::ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    asked = request;
    Plan plan = server::PlanTo(belief, request.robot, 3.0);
    plan.seed = request.seed;
    plan.explanation = "because";
    plan.trajectory.waypoints = {{{0.0, 0.0, 0.0}, 0.0, 0.0}, {{3.0, 0.0, 0.0}, 2.4, 0.5}};
    return absl::StatusOr<Plan>(plan);
  }));
  PlanQuery query = Query();
  query.request.start = Pose2{1.5, -2.5, 0.25};
  query.request.seed = 0xfedc'ba98'7654'3210;  // beyond int64
  query.request.max_edge_evaluations = 1234;

  const auto plan = client_->NextBestTrajectory("house", query);

  ASSERT_TRUE(plan.ok()) << plan.status();
  ASSERT_TRUE(asked.has_value());
  EXPECT_EQ(asked->robot, "scout");
  EXPECT_EQ(asked->start, query.request.start);
  EXPECT_EQ(asked->seed, query.request.seed);
  EXPECT_EQ(asked->max_edge_evaluations, 1234);
  EXPECT_EQ(plan->id, 1);
  EXPECT_EQ(plan->robot, "scout");
  EXPECT_EQ(plan->seed, query.request.seed);
  EXPECT_EQ(plan->explanation, "because");
  ASSERT_EQ(plan->candidates.size(), 1U);
  EXPECT_EQ(plan->candidates[0].goal.position, (Point2{3.0, 0.0}));
  EXPECT_EQ(plan->trajectory.waypoints[1], (Waypoint{{3.0, 0.0, 0.0}, 2.4, 0.5}));
}

TEST_F(GrpcPlannerClientTest, TheBudgetStopsTheSearch) {
  Start(server::ScriptedHooks(
      [&](const Belief& belief, const PlanRequest& request, const StopFn& stop) {
        while (!stop()) absl::SleepFor(absl::Milliseconds(1));
        return absl::StatusOr<Plan>(server::PlanTo(belief, request.robot, 1.0));
      }));
  PlanQuery query = Query();
  query.budget = absl::Milliseconds(20);

  const auto plan = client_->NextBestTrajectory("house", query);

  EXPECT_TRUE(plan.ok()) << plan.status();  // much earlier than the timeout
}

TEST_F(GrpcPlannerClientTest, AnEndlessBudgetIsUnderstood) {
  Start(server::ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    return absl::StatusOr<Plan>(server::PlanTo(belief, request.robot, 1.0));
  }));
  PlanQuery query = Query();
  query.budget = absl::InfiniteDuration();

  const auto plan = client_->NextBestTrajectory("house", query);

  EXPECT_TRUE(plan.ok()) << plan.status();
}

TEST_F(GrpcPlannerClientTest, ACallThatOutlivesItsTimeoutIsGivenUpAndTheLinkLivesOn) {
  absl::Notification release;
  Start(server::ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
    release.WaitForNotificationWithTimeout(kPatience);  // deaf to `stop`
    return absl::StatusOr<Plan>(server::PlanTo(belief, request.robot, 1.0));
  }));
  PlanQuery query = Query();
  query.timeout = absl::Milliseconds(100);

  const absl::Status status = client_->NextBestTrajectory("house", query).status();
  release.Notify();

  EXPECT_TRUE(absl::IsDeadlineExceeded(status)) << status;
  EXPECT_THAT(*client_->ListMissions(), ElementsAre("house"));
  server_.reset();  // its search may only begin now, and waits for `release`
}

// The server is too slow for the first call: nobody hears its answer.
TEST_F(GrpcPlannerClientTest, ARegistrationWhoseAnswerWasLostIsMadeOnce) {
  absl::Notification release;
  std::atomic<int> registrations = 0;
  server::RegistryHooks hooks;
  hooks.make_event_sink = [&](const MissionId&, const MissionOptions&) {
    return [&](const Event& event) {
      release.WaitForNotification();
      if (std::holds_alternative<RobotRegistered>(event.body)) ++registrations;
    };
  };
  server_ = StartServer(0, hooks);
  ASSERT_NE(server_, nullptr);
  ASSERT_TRUE(MakeGrpcPlannerClient(At(server_->port()))->CreateMission("house", {}).ok());
  GrpcClientOptions options = At(server_->port());
  options.call_timeout = absl::Milliseconds(150);
  const auto hasty = MakeGrpcPlannerClient(options);

  const absl::Status lost = hasty->RegisterRobot("house", "scout", 0.2, false).status();
  release.Notify();
  auto session = hasty->RegisterRobot("house", "scout", 0.2, false);
  const absl::Time end = absl::Now() + kPatience;
  while (IsRetriable(session.status()) && absl::Now() < end) {
    session = hasty->RegisterRobot("house", "scout", 0.2, false);
  }

  EXPECT_FALSE(lost.ok());
  ASSERT_TRUE(session.ok()) << session.status();
  EXPECT_EQ(registrations, 1);
}

}  // namespace grpc_planner_client_test
}  // namespace plumescout::client
