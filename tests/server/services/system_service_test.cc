// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/system_service.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "absl/synchronization/notification.h"
#include "server/base/version.h"
#include "tests/server/service_fixture.h"

namespace plumescout::server {
namespace system_service_test {

class SystemServiceTest : public ServiceTest {
 protected:
  absl::StatusOr<v1::GetServerInfoResponse> Info() {
    return Call(system_, &v1::SystemService::Stub::GetServerInfo, v1::GetServerInfoRequest());
  }
  absl::Status DrainServer() {
    return Call(system_, &v1::SystemService::Stub::DrainServer, v1::DrainServerRequest()).status();
  }
};

TEST_F(SystemServiceTest, InfoTellsWhatIsConfigured) {
  ServerConfig config;
  config.limits.max_missions = 7;
  config.limits.max_scans_per_s = 12.5;
  config.limits.max_clock_lead_s = 2.5;
  config.planning.max_budget_s = 1.5;
  StartServer(config);
  const auto info = Info();
  ASSERT_TRUE(info.ok()) << info.status();
  EXPECT_EQ(info->version(), kVersion);
  EXPECT_EQ(info->boot_id(), server_->boot_id());
  EXPECT_EQ(info->caller(), "anonymous");
  EXPECT_EQ(info->caller_role(), "admin");
  EXPECT_EQ(info->features_size(), 0);
  const v1::ServerLimits& limits = info->limits();
  EXPECT_EQ(limits.max_mission_count(), 7);
  EXPECT_EQ(limits.max_map_part_bytes(), config.maps.max_part_bytes);
  EXPECT_EQ(limits.memory_budget_bytes(), config.limits.memory_budget_bytes);
  EXPECT_EQ(limits.mission_memory_budget_bytes(), config.limits.mission_memory_budget_bytes);
  EXPECT_EQ(limits.max_receive_bytes(), config.limits.max_receive_bytes);
  EXPECT_EQ(limits.max_batch_observation_count(), config.limits.max_batch_observations);
  EXPECT_EQ(limits.stream_window_observation_count(), config.limits.stream_window_observations);
  EXPECT_EQ(limits.max_beam_count(), config.mission.max_beam_count);
  EXPECT_EQ(limits.max_scans_per_s(), 12.5);
  EXPECT_EQ(limits.max_gas_readings_per_s(), config.limits.max_gas_readings_per_s);
  EXPECT_EQ(limits.max_plans_per_s(), config.limits.max_plans_per_s);
  EXPECT_EQ(limits.max_calls_per_s(), config.limits.max_calls_per_s);
  EXPECT_EQ(limits.max_costly_calls_per_s(), config.limits.max_costly_calls_per_s);
  EXPECT_EQ(limits.max_ingest_bytes_per_s(), config.limits.max_ingest_bytes_per_s);
  EXPECT_EQ(limits.ingest_burst().seconds(), 60);
  EXPECT_EQ(limits.max_mission_beam_count(), config.limits.max_beam_count);
  EXPECT_EQ(limits.max_range_m(), config.limits.max_range_m);
  EXPECT_EQ(limits.max_map_cell_count(), config.limits.max_map_cell_count);
  EXPECT_EQ(limits.max_import_bytes(), config.limits.max_import_bytes);
  EXPECT_EQ(limits.max_wait().seconds(), 30);
  EXPECT_EQ(limits.max_robot_watcher_count(), config.limits.max_watchers_per_robot);
  EXPECT_EQ(limits.max_clock_lead().seconds(), 2);
  EXPECT_EQ(limits.max_clock_lead().nanos(), 500'000'000);
  EXPECT_EQ(limits.max_planning_budget().seconds(), 1);
}

TEST_F(SystemServiceTest, UptimeGrows) {
  StartServer();
  const auto uptime_ns = [this] {
    const google::protobuf::Duration uptime = Info()->uptime();
    return uptime.seconds() * 1'000'000'000 + uptime.nanos();
  };
  const std::int64_t first_ns = uptime_ns();
  EXPECT_GT(first_ns, 0);
  EXPECT_GT(uptime_ns(), first_ns);
}

TEST_F(SystemServiceTest, DrainAnswersAndThenAsksWhoeverRunsTheServer) {
  absl::Notification asked;
  StartServer({}, {}, [&] { asked.Notify(); });
  EXPECT_TRUE(DrainServer().ok());
  asked.WaitForNotification();
  EXPECT_TRUE(Info().ok()) << "the drain itself is the other's doing";
  server_.reset();
}

TEST_F(SystemServiceTest, AServerThatIsPartOfAnotherProcessIsNotDrained) {
  StartServer();
  EXPECT_THAT(DrainServer(), Refuses(absl::StatusCode::kUnimplemented, "UNIMPLEMENTED"));
}

}  // namespace system_service_test
}  // namespace plumescout::server
