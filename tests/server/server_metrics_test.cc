// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/server_metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <map>
#include <string>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_split.h"
#include "absl/synchronization/notification.h"
#include "tests/server/host_parts.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace server_metrics_test {

using ::testing::HasSubstr;
using ::testing::Not;

// Values by name and labels.
std::map<std::string, double> ValuesOf(const std::string& text) {
  std::map<std::string, double> values;
  for (const absl::string_view line : absl::StrSplit(text, '\n', absl::SkipEmpty())) {
    if (absl::StartsWith(line, "#")) continue;
    const std::size_t space = line.rfind(' ');
    double value = 0.0;
    EXPECT_TRUE(absl::SimpleAtod(line.substr(space + 1), &value)) << line;
    EXPECT_TRUE(values.emplace(line.substr(0, space), value).second) << line << " stands twice";
  }
  return values;
}

class ServerMetricsTest : public ServiceTest {
 protected:
  std::map<std::string, double> Metrics() const { return ValuesOf(server_->MetricsText()); }
};

TEST_F(ServerMetricsTest, WhatRobotsDoIsCounted) {
  StartServer();
  const std::int64_t lease = Lease();
  ASSERT_TRUE(Ingest(kRobot, lease, RoomScan(1)).ok());
  ASSERT_TRUE(Ingest(kRobot, lease, GasReadings(2, 20)).ok());
  EXPECT_FALSE(Ingest(kRobot, lease + 1, GasReadings(21, 21)).ok());
  ASSERT_TRUE(NextBest(PlanFor(lease)).ok());
  const auto metrics = Metrics();
  const std::string calls = "plumescout_rpc_calls_total{code=\"";
  EXPECT_EQ(metrics.at(calls + "OK\",method=\"BatchIngestObservations\","
                               "service=\"IngestService\"}"),
            2);
  EXPECT_EQ(metrics.at(calls + "FAILED_PRECONDITION\",method=\"BatchIngestObservations\","
                               "service=\"IngestService\"}"),
            1);
  EXPECT_EQ(metrics.at("plumescout_observations_total{outcome=\"applied\"}"), 20);
  EXPECT_EQ(metrics.at("plumescout_observations_total{outcome=\"rejected\"}"), 0);
  EXPECT_EQ(metrics.at("plumescout_ingest_lag_seconds_count"), 2);
  EXPECT_EQ(metrics.at("plumescout_plan_cpu_seconds_count"), 1);
  for (const char* stage : {"belief", "queue", "search", "commit"}) {
    EXPECT_EQ(metrics.at(absl::StrCat("plumescout_plan_stage_duration_seconds_count{stage=\"",
                                      stage, "\"}")),
              1);
  }
  EXPECT_GE(metrics.at("plumescout_gas_refresh_duration_seconds_count"), 1);
  EXPECT_EQ(metrics.at("plumescout_missions"), 1);
  EXPECT_EQ(metrics.at("plumescout_mission_robots{mission=\"hall\"}"), 1);
  EXPECT_GT(metrics.at("plumescout_mission_revision{mission=\"hall\"}"), 20);
  EXPECT_GT(metrics.at("plumescout_mission_memory_bytes{mission=\"hall\"}"), 0);
  EXPECT_GT(metrics.at("plumescout_mission_memory_budget_bytes{mission=\"hall\"}"),
            metrics.at("plumescout_mission_memory_bytes{mission=\"hall\"}"));
  EXPECT_EQ(metrics.at("plumescout_memory_reserved_bytes"),
            static_cast<double>(MissionOptions{}.memory_budget_bytes));
  EXPECT_EQ(metrics.at("plumescout_memory_budget_bytes"),
            static_cast<double>(LimitConfig{}.memory_budget_bytes));
  EXPECT_GT(metrics.at("plumescout_process_resident_memory_bytes"), 1e6);
}

TEST_F(ServerMetricsTest, SeriesOfAMissionGoWithIt) {
  StartServer();
  ASSERT_TRUE(CreateMission("attic").ok());
  EXPECT_THAT(server_->MetricsText(), HasSubstr("{mission=\"attic\"}"));
  ASSERT_TRUE(DeleteMission("attic").ok());
  EXPECT_THAT(server_->MetricsText(), Not(HasSubstr("attic")));
  EXPECT_EQ(Metrics().at("plumescout_missions"), 1);
}

TEST(ServerStateTest, MissionsBeyondABoundHaveNoSeries) {
  MissionRegistry registry(RegistryOptions{}, RegistryHooks{});
  const ActiveStreams streams;
  for (const char* id : {"a", "b", "c"}) {
    ASSERT_TRUE(registry.Create(id, MissionOptions{}, {"alice", "acme"}).ok());
  }
  ServerState state;
  state.missions = &registry;
  state.streams = &streams;
  state.max_missions = 64;
  state.max_mission_series = 2;
  const auto metrics = ValuesOf(ServerMetrics().Text(state));
  EXPECT_EQ(metrics.at("plumescout_missions"), 3);
  EXPECT_EQ(metrics.at("plumescout_missions_without_series"), 1);
  const std::string revision = "plumescout_mission_revision{mission=";
  EXPECT_EQ(metrics.count(revision + R"("b",tenant="acme"})"), 1u);
  EXPECT_EQ(metrics.count(revision + R"("c",tenant="acme"})"), 0u);
  registry.StopAll(absl::CancelledError("over"));
}

TEST_F(ServerMetricsTest, WatchersAndStreamsAreCounted) {
  StartServer();
  WatchClient watch(*maps_);
  ASSERT_EQ(watch.Read().kind(), v1::WatchMapResponse::KIND_FULL);
  EXPECT_EQ(Metrics().at("plumescout_open_streams"), 1);
  EXPECT_TRUE(GetMap().ok());  // through the mission's queue: what came before is counted
  EXPECT_EQ(Metrics().at("plumescout_mission_watchers{mission=\"hall\"}"), 1);
  watch.Cancel();
  watch.Finish().IgnoreError();
}

TEST_F(ServerMetricsTest, QueuesAreSeen) {
  absl::Notification searching;
  absl::Notification release;
  ServerConfig config;
  config.planning.threads = 1;
  StartServer(config,
              ScriptedHooks([&](const Belief& belief, const PlanRequest& request, const StopFn&) {
                if (!searching.HasBeenNotified()) searching.Notify();
                release.WaitForNotification();
                return PlanTo(belief, request.robot, 1.0);
              }));
  const std::int64_t lease = Lease();
  auto plan = std::async(std::launch::async, [&] { return NextBest(PlanFor(lease)).status(); });
  searching.WaitForNotification();
  const auto metrics = Metrics();
  EXPECT_EQ(metrics.at("plumescout_pool_threads{pool=\"planning\"}"), 1);
  EXPECT_EQ(metrics.at("plumescout_pool_busy_threads{pool=\"planning\"}"), 1);
  EXPECT_EQ(metrics.at("plumescout_pool_queue_depth{pool=\"planning\"}"), 0);
  EXPECT_EQ(metrics.at("plumescout_pool_queue_limit{pool=\"planning\"}"), 64);
  EXPECT_EQ(metrics.at("plumescout_pool_refused_total{pool=\"planning\"}"), 0);
  release.Notify();
  EXPECT_TRUE(plan.get().ok());
}

}  // namespace server_metrics_test
}  // namespace plumescout::server
