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

#include "absl/synchronization/notification.h"
#include "tests/server/health_client.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace server_test {

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

TEST_F(ServerTest, HealthSaysThatTheServerDrains) {
  absl::Notification searching;
  absl::Notification release;
  StartServer(WithDrain(60.0),
              ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
                searching.Notify();
                release.WaitForNotification();
                return PlanTo(belief, request.robot, 1.0);
              }));
  HealthWatch health(channel_);
  ASSERT_EQ(health.Read(), Health::kServing);
  auto plan = AskForAPlan(Lease());
  searching.WaitForNotification();
  auto drained = std::async(std::launch::async, [this] { server_->Drain(); });
  EXPECT_EQ(health.Read(), Health::kNotServing);
  health.Cancel();
  // The call in flight is let finish.
  release.Notify();
  EXPECT_TRUE(plan.get().ok());
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

TEST_F(ServerTest, DrainCancelsWhatOutlastsIt) {
  absl::Notification searching;
  std::atomic<bool> stopped = false;
  StartServer(WithDrain(0.05), ScriptedHooks([&](const Belief& belief, const PlanRequest& request,
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
  EXPECT_FALSE(plan.get().ok());
  server_.reset();
  EXPECT_TRUE(stopped);
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

}  // namespace server_test
}  // namespace plumescout::server
