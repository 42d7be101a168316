// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "server/observe/http_endpoints.h"
#include "tests/server/captured_log.h"
#include "tests/server/health_client.h"
#include "tests/server/host_parts.h"
#include "tests/server/http_client.h"
#include "tests/server/service_fixture.h"
#include "tests/server/writer_gate.h"

namespace plumescout::server {
namespace server_test {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

constexpr auto kUnavailable = absl::StatusCode::kUnavailable;

class ServerTest : public ServiceTest {
 protected:
  // A call for a plan, and its answer.
  std::future<absl::Status> AskForAPlan(std::int64_t lease) {
    return std::async(std::launch::async,
                      [this, lease] { return NextBest(PlanFor(lease)).status(); });
  }
};

ServerConfig WithDrain(double seconds) {
  ServerConfig config;
  config.connection.drain_s = seconds;
  return config;
}

TEST_F(ServerTest, HealthServes) {
  StartServer();
  HealthWatch health(channel_);
  EXPECT_EQ(health.Read(), Health::kServing);
}

TEST_F(ServerTest, HealthSaysThatTheServerDrainsAndCallsInFlightFinish) {
  WriterGate gate;
  StartServer(WithDrain(60.0), gate.Hooks());
  HealthWatch health(channel_);
  ASSERT_EQ(health.Read(), Health::kServing);
  const std::int64_t lease = Lease();
  auto ingested = std::async(std::launch::async,
                             [&] { return Ingest(kRobot, lease, GasReadings(1, 1)).status(); });
  gate.AwaitHeld();
  auto drained = std::async(std::launch::async, [this] { server_->Drain(); });
  EXPECT_EQ(health.Read(), Health::kNotServing);
  health.Cancel();
  gate.Release();
  EXPECT_TRUE(ingested.get().ok());
  drained.get();
}

TEST_F(ServerTest, ReadinessOverHttpEndsWithTheDrainAndHttpDoesNot) {
  WriterGate gate;
  StartServer(WithDrain(60.0), gate.Hooks());
  const auto http = HttpEndpoints::Start("127.0.0.1:0", {[this] { return server_->MetricsText(); },
                                                         [this] { return server_->NotReady(); }});
  ASSERT_TRUE(http.ok()) << http.status();
  EXPECT_EQ(HttpGet((*http)->port(), "/readyz").code, 200);
  HealthWatch health(channel_);
  ASSERT_EQ(health.Read(), Health::kServing);
  const std::int64_t lease = Lease();
  auto ingested = std::async(std::launch::async,
                             [&] { return Ingest(kRobot, lease, GasReadings(1, 1)).status(); });
  gate.AwaitHeld();
  auto drained = std::async(std::launch::async, [this] { server_->Drain(); });
  EXPECT_EQ(health.Read(), Health::kNotServing);
  health.Cancel();
  EXPECT_EQ(HttpGet((*http)->port(), "/readyz").code, 503);
  EXPECT_EQ(HttpGet((*http)->port(), "/healthz").code, 200);
  EXPECT_THAT(HttpGet((*http)->port(), "/metrics").body, HasSubstr("\nplumescout_draining 1\n"));
  gate.Release();
  EXPECT_TRUE(ingested.get().ok());
  drained.get();
}

TEST_F(ServerTest, DrainEndsStreamsAndSaysWhenToRetry) {
  StartServer(WithDrain(60.0));
  IngestClient ingest(*ingest_);
  ASSERT_TRUE(ingest.Open(kRobot, Lease()));
  ASSERT_TRUE(ingest.Read().has_opened());
  WatchClient watch(*maps_);
  ASSERT_EQ(watch.Read().kind(), v1::WatchMapResponse::KIND_FULL);
  auto drained = std::async(std::launch::async, [this] { server_->Drain(); });
  const absl::Status ended = ingest.Finish();
  EXPECT_THAT(ended, Refuses(kUnavailable, "DRAINING"));
  EXPECT_TRUE(RetryDelay(ended).has_value());
  EXPECT_THAT(watch.Finish(), Refuses(kUnavailable, "DRAINING"));
  drained.get();
}

TEST_F(ServerTest, DrainStopsSearches) {
  absl::Notification searching;
  std::atomic<bool> stopped = false;
  StartServer(WithDrain(60.0), ScriptedHooks([&](const Belief& belief, const PlanRequest& request,
                                                 const StopFn& stop) {
                searching.Notify();
                while (!stop()) {
                }
                stopped = true;
                return PlanTo(belief, request.robot, 1.0);
              }));
  auto plan = AskForAPlan(Lease());
  searching.WaitForNotification();
  server_->Drain();
  EXPECT_THAT(plan.get(), Refuses(kUnavailable, "DRAINING"));
  server_.reset();
  EXPECT_TRUE(stopped);
}

TEST_F(ServerTest, DrainDoesNotWaitForASearchThatGoesOn) {
  absl::Notification searching;
  absl::Notification release;
  StartServer(WithDrain(60.0),
              ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
                searching.Notify();
                release.WaitForNotification();
                return PlanTo(belief, request.robot, 1.0);
              }));
  auto plan = AskForAPlan(Lease());
  searching.WaitForNotification();
  server_->Drain();
  EXPECT_THAT(plan.get(), Refuses(kUnavailable, "DRAINING"));
  release.Notify();
  server_.reset();  // its search uses what is above
}

// Returns when so many calls wait for a belief of mission hall.
void AwaitWaitingCalls(const Server& server, int calls) {
  const std::string wanted =
      absl::StrCat("plumescout_mission_waiting_calls{mission=\"hall\"} ", calls, "\n");
  const SteadyTime deadline = After(SteadyNow(), absl::Seconds(30));
  while (!absl::StrContains(server.MetricsText(), wanted)) {
    ASSERT_LT(SteadyNow(), deadline);
    std::this_thread::yield();
  }
}

TEST_F(ServerTest, DrainEndsPlansThatWaitForReadings) {
  StartServer(WithDrain(60.0));
  PlanStreamClient stream(*planning_, [&] {
    v1::StreamNextBestTrajectoryRequest request;
    request.set_robot(kRobot);
    request.set_lease_token(Lease());
    request.set_min_applied_sequence(1000);
    return request;
  }());
  auto plan = std::async(std::launch::async, [&, lease = Register("r2")->lease_token()] {
    v1::NextBestTrajectoryRequest request = PlanFor(lease);
    request.set_robot("missions/hall/robots/r2");
    request.set_min_applied_sequence(1000);
    return NextBest(request).status();
  });
  AwaitWaitingCalls(*server_, 2);
  auto drained = std::async(std::launch::async, [this] { server_->Drain(); });
  EXPECT_EQ(stream.Finish().code(), kUnavailable);
  EXPECT_EQ(plan.get().code(), kUnavailable);
  drained.get();
}

// The mission's writer is busy for longer than the drain may take: what is queued behind that is
// answered, and nobody waits for it.
TEST_F(ServerTest, DrainDoesNotWaitForABusyMission) {
  WriterGate gate;
  StartServer(WithDrain(0.05), gate.Hooks());
  const std::int64_t lease = Lease();
  IngestClient stream(*ingest_);
  ASSERT_TRUE(stream.Open(kRobot, lease));
  ASSERT_TRUE(stream.Read().has_opened());
  ASSERT_TRUE(stream.Send(GasReadings(1, 1)));
  gate.AwaitHeld();
  auto ingested = std::async(std::launch::async,
                             [&] { return Ingest(kRobot, lease, GasReadings(2, 2)).status(); });
  auto map = std::async(std::launch::async, [&] { return GetMap().status(); });
  EXPECT_FALSE(DeleteMission("attic").ok());  // a round trip: the others are probably there too
  server_->Drain();
  EXPECT_EQ(stream.Finish().code(), kUnavailable);
  EXPECT_FALSE(ingested.get().ok());
  EXPECT_FALSE(map.get().ok());
  gate.Release();
}

TEST_F(ServerTest, DrainedServerAnswersNoMore) {
  StartServer();
  server_->Drain();
  server_->Drain();
  EXPECT_EQ(CreateMission("attic").status().code(), kUnavailable);
}

TEST_F(ServerTest, PortInUseIsAnError) {
  StartServer();
  ServerConfig config;
  config.listen = absl::StrCat("127.0.0.1:", server_->port());
  const absl::Status refused = Server::Start(config).status();
  EXPECT_TRUE(absl::IsUnavailable(refused));
  EXPECT_EQ(refused.message(), absl::StrCat("cannot listen on ", config.listen));
  EXPECT_TRUE(CreateMission("attic").ok());
}

TEST_F(ServerTest, AddressThatIsNoneIsAnError) {
  ServerConfig config;
  config.listen = "no such address";
  EXPECT_TRUE(absl::IsUnavailable(Server::Start(config).status()));
}

TEST_F(ServerTest, NoAddressServesTheSameProcessOnly) {
  ServerConfig config;
  config.listen.clear();
  const auto server = Server::Start(config);
  ASSERT_TRUE(server.ok()) << server.status();
  EXPECT_EQ((*server)->port(), 0);
  missions_ = v1::MissionService::NewStub((*server)->InProcessChannel());
  EXPECT_TRUE(CreateMission("attic").ok());
}

TEST_F(ServerTest, MessageLargerThanTheLimitIsRefused) {
  StartServer();
  const std::int64_t lease = Lease();
  v1::ObservationBatch batch = GasReadings(1, 1);
  batch.mutable_observations(0)->mutable_scan()->mutable_ranges_u16()->resize(
      static_cast<std::size_t>(LimitConfig{}.max_receive_bytes));
  EXPECT_EQ(Ingest(kRobot, lease, batch).status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(Revision(), 1);
}

TEST_F(ServerTest, BytesThatAreNoMessageAreRefused) {
  StartServer();
  const grpc::Slice bytes("\x0a\xff\xff\xff");  // a string whose length runs past the end
  grpc::GenericStub stub(channel_);
  for (const char* method : {"MissionService/CreateMission", "RobotService/RegisterRobot",
                             "IngestService/BatchIngestObservations", "MapService/GetMap",
                             "PlanningService/NextBestTrajectory"}) {
    grpc::ClientContext context;
    SetPatience(context);
    const grpc::ByteBuffer request(&bytes, 1);
    grpc::ByteBuffer response;
    std::promise<grpc::Status> status;
    stub.UnaryCall(&context, absl::StrCat("/plumescout.v1.", method), {}, &request, &response,
                   [&](grpc::Status ended) { status.set_value(std::move(ended)); });
    EXPECT_FALSE(status.get_future().get().ok()) << method;  // which code is gRPC's choice
    EXPECT_EQ(Revision(), 0);
  }
}

// The answer to a call of any method with these bytes as request.
grpc::Status CallWithBytes(const std::shared_ptr<grpc::Channel>& channel, const std::string& method,
                           const std::string& bytes, const std::string& request_id = "") {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  SetPatience(context);
  if (!request_id.empty()) context.AddMetadata("x-request-id", request_id);
  const grpc::Slice slice(bytes);
  const grpc::ByteBuffer request(&slice, 1);
  grpc::ByteBuffer response;
  std::promise<grpc::Status> status;
  stub.UnaryCall(&context, method, {}, &request, &response,
                 [&](grpc::Status ended) { status.set_value(std::move(ended)); });
  return status.get_future().get();
}

TEST_F(ServerTest, ErrorsNameTheRequest) {
  StartServer();
  const std::string method = "/plumescout.v1.MissionService/GetMission";
  EXPECT_EQ(RequestId(ToAbsl(CallWithBytes(channel_, method, "", "abc-7"))), "abc-7");
  // Who sends none, or no word, gets one.
  EXPECT_EQ(RequestId(ToAbsl(CallWithBytes(channel_, method, ""))).size(), 16u);
  EXPECT_EQ(RequestId(ToAbsl(CallWithBytes(channel_, method, "", "a b"))).size(), 16u);
  WatchClient watch(*maps_, "missions/none");
  EXPECT_EQ(RequestId(watch.Finish()).size(), 16u);
}

TEST_F(ServerTest, ReflectionAndChannelzAreServedByOption) {
  const std::string reflection = "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo";
  const std::string channelz = "/grpc.channelz.v1.Channelz/GetServers";
  const std::string list_services = {'\x3a', '\0'};  // with an empty text
  const auto code = [&](const std::string& method, const std::string& bytes) {
    return CallWithBytes(channel_, method, bytes).error_code();
  };
  StartServer();
  EXPECT_EQ(code(reflection, list_services), grpc::StatusCode::OK);
  EXPECT_EQ(code(channelz, ""), grpc::StatusCode::UNIMPLEMENTED);
  ServerConfig config;
  config.observe.reflection = false;
  config.observe.channelz = true;
  StartServer(config);
  EXPECT_EQ(code(reflection, list_services), grpc::StatusCode::UNIMPLEMENTED);
  EXPECT_EQ(code(channelz, ""), grpc::StatusCode::OK);
}

TEST_F(ServerTest, SlowCallsAreLogged) {
  ServerConfig config;
  config.observe.slow_call_s = 0.0;
  StartServer(config);
  const std::int64_t lease = Lease();
  const std::string log = LogOf([&] {
    ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
    ASSERT_TRUE(NextBest(PlanFor(lease)).ok());
  });
  EXPECT_THAT(log, ContainsRegex("WARNING slow call method=IngestService/BatchIngestObservations "
                                 "caller=anonymous code=OK duration_ms=[0-9]+ commit_ms=[0-9]+ "
                                 "request_id="));
  EXPECT_THAT(log, ContainsRegex("WARNING slow call method=PlanningService/NextBestTrajectory "
                                 "caller=anonymous code=OK duration_ms=[0-9]+ belief_ms=[0-9]+ "
                                 "queue_ms=[0-9]+ search_ms=[0-9]+ commit_ms=[0-9]+ "
                                 "durable_ms=[0-9]+ request_id="));
  EXPECT_THAT(log, ContainsRegex("INFO plan mission=hall robot=r1 .* request_id="));
}

TEST_F(ServerTest, RestartedServerIsRecognisedAndItsLeasesAreNew) {
  StartServer();
  const std::string boot_id = server_->boot_id();
  const std::int64_t lease = Lease();
  StartServer();
  EXPECT_NE(server_->boot_id(), boot_id);
  ASSERT_TRUE(Register("r1").ok());
  EXPECT_THAT(Ingest(kRobot, lease, GasReadings(1, 1)).status(),
              Refuses(absl::StatusCode::kFailedPrecondition, "LEASE_SUPERSEDED"));
}

TEST_F(ServerTest, ResendingEverythingAfterARestartMakesTheSameMap) {
  std::string maps[2];
  for (std::string& map : maps) {
    StartServer();
    const std::int64_t lease = Lease();
    ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
    ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(2, 20)).ok());
    ASSERT_TRUE(NextBest(PlanFor(lease)).ok());  // brings the posterior up to date
    const auto response = GetMap(/*full_precision=*/true);
    ASSERT_TRUE(response.ok()) << response.status();
    map = response->SerializeAsString();
  }
  EXPECT_FALSE(maps[0].empty());
  EXPECT_EQ(maps[0], maps[1]);
}

TEST_F(ServerTest, LeaseTokensFitIntoADouble) {
  for (int start = 0; start < 5; ++start) {
    StartServer();
    const std::int64_t lease = Lease();
    EXPECT_GT(lease, 0);
    EXPECT_LT(lease, std::int64_t{1} << 53);
  }
}

}  // namespace server_test
}  // namespace plumescout::server
