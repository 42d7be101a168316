// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Whole robots over a real connection, and what becomes of them when the server restarts.

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/grpc_planner_client.h"
#include "client/robot_loop.h"
#include "server/server.h"
#include "tests/client/fake_driver.h"

namespace plumescout::client {
namespace robot_over_grpc_test {

constexpr double kTimeLimit_s = 20.0;

std::unique_ptr<server::Server> StartServer(int port) {
  server::ServerConfig config;
  config.listen = absl::StrCat("127.0.0.1:", port);
  config.planning.max_budget_s = 60.0;  // enough on any machine
  auto started = server::Server::Start(config);
  EXPECT_TRUE(started.ok()) << started.status();
  return started.ok() ? *std::move(started) : nullptr;
}

RobotLoopOptions Options(Pacing pacing) {
  RobotLoopOptions options;
  options.participation = {.mission = "room", .robot = "scout", .create = MissionOptions{}};
  options.pacing = pacing;
  options.following = Following::kIdeal;
  options.time_limit_s = kTimeLimit_s;
  options.ingest.backoff = {.initial = absl::Milliseconds(5), .maximum = absl::Milliseconds(50)};
  return options;
}

class RobotOverGrpcTest : public ::testing::Test {
 protected:
  void SetUp() override {
    server_ = StartServer(0);
    ASSERT_NE(server_, nullptr);
    client_ = MakeGrpcPlannerClient({.target = absl::StrCat("127.0.0.1:", server_->port())});
  }

  absl::StatusOr<RobotResult> Run(Pacing pacing) {
    RobotObserver observer;
    RobotLoop loop(*client_, driver_, Options(pacing), observer);
    return loop.Run(NeverStop());
  }
  // Drops everything that the server knew.
  void RestartServer() {
    const int port = server_->port();
    server_.reset();
    server_ = StartServer(port);
  }

  std::unique_ptr<server::Server> server_;
  std::unique_ptr<PlannerClient> client_;
  FakeDriver driver_{4.0};
};

TEST_F(RobotOverGrpcTest, InLockstepARobotMapsItsRoom) {
  const absl::StatusOr<RobotResult> result = Run(Pacing::kLockstep);

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_GT(result->plans, 0);
  EXPECT_GT(result->distance_m, 1.0);
  const absl::StatusOr<MapSnapshot> map = client_->GetMap("room");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ(map->robots[0].applied_sequence, result->ingest.last_sequence);
  EXPECT_EQ(map->occupancy.At(map->occupancy.geometry().CellAt({0.0, 0.0}), CellState::kUnknown),
            CellState::kFree);
}

TEST_F(RobotOverGrpcTest, ARestartedServerIsToldEverythingAndTheMissionGoesOn) {
  const std::int64_t restart_ns = driver_.now_ns() + 8'000'000'000;
  bool restarted = false;
  driver_.on_advance = [&] {
    if (restarted || driver_.now_ns() < restart_ns) return;
    restarted = true;
    RestartServer();
  };

  const absl::StatusOr<RobotResult> result = Run(Pacing::kLockstep);

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->ingest.server_restarts, 1);
  EXPECT_EQ(result->ingest.applied_sequence, result->ingest.last_sequence);
  EXPECT_EQ(result->ingest.lost, 0);
  // Two gas readings a second from the first second on, though this server began at the eighth.
  EXPECT_GE(client_->GetMap("room")->gas_counters.readings,
            static_cast<std::int64_t>(2 * result->elapsed_s) - 1);
}

TEST_F(RobotOverGrpcTest, RunningFreelyARobotSurvivesARestart) {
  int ticks = 0;
  driver_.on_advance = [&] {
    absl::SleepFor(absl::Milliseconds(5));  // twenty times real time
    if (++ticks == 60) RestartServer();
  };

  const absl::StatusOr<RobotResult> result = Run(Pacing::kFreeRunning);

  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->ingest.server_restarts, 1);
  EXPECT_EQ(result->ingest.applied_sequence, result->ingest.last_sequence);
}

}  // namespace robot_over_grpc_test
}  // namespace plumescout::client
