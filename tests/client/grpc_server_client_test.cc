// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/grpc_server_client.h"

#include <gtest/gtest.h>

#include "absl/strings/str_cat.h"
#include "absl/synchronization/notification.h"
#include "server/server.h"
#include "tests/client/ingest_traffic.h"

namespace plumescout::client {
namespace grpc_server_client_test {

TEST(GrpcServerClientTest, AServerTellsOfItselfAndIsDrained) {
  server::ServerConfig config;
  config.listen = "127.0.0.1:0";
  config.limits.max_missions = 3;
  config.planning.max_budget_s = 1.5;
  absl::Notification drained;
  auto started = server::Server::Start(config, {}, {.drain = [&] { drained.Notify(); }});
  ASSERT_TRUE(started.ok()) << started.status();
  const auto client = MakeGrpcServerClient(
      {.target = absl::StrCat("127.0.0.1:", (*started)->port()), .call_timeout = kPatience});
  const auto info = client->GetServerInfo();
  ASSERT_TRUE(info.ok()) << info.status();
  EXPECT_FALSE(info->version.empty());
  EXPECT_FALSE(info->boot_id.empty());
  EXPECT_GE(info->uptime, absl::ZeroDuration());
  EXPECT_EQ(info->limits.max_missions, 3);
  EXPECT_EQ(info->limits.max_planning_budget, absl::Milliseconds(1500));
  EXPECT_EQ(info->limits.max_receive_bytes, config.limits.max_receive_bytes);
  EXPECT_EQ(info->caller_role, "admin") << "where nobody is asked who they are";
  EXPECT_EQ(info->store.engine, "none");
  EXPECT_FALSE(info->store.is_available);
  ASSERT_EQ(client->DrainServer(), absl::OkStatus());
  EXPECT_TRUE(drained.WaitForNotificationWithTimeout(kPatience));
}

}  // namespace grpc_server_client_test
}  // namespace plumescout::client
