// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission host: what audits of its mission find.
#include <gtest/gtest.h>
#include <prometheus/text_serializer.h>

#include <memory>
#include <string>
#include <utility>

#include "absl/synchronization/notification.h"
#include "absl/time/clock.h"
#include "server/missions/mission_host.h"
#include "tests/server/host_parts.h"
#include "tests/support/room_run.h"

namespace plumescout::server {
namespace mission_host_audit_test {

TEST(MissionHostAuditTest, AFindingIsCollectedThoughNothingElseHappens) {
  prometheus::Registry registry;
  MissionMetrics metrics(registry);
  WorkerPool pool({"audit", 1, 2});
  absl::Notification quiet;
  ASSERT_TRUE(pool.Submit([&] { quiet.WaitForNotification(); }).ok());
  MissionHost::Parts parts = HostParts();
  parts.mission = std::make_unique<Mission>(support::FastAgeing());
  parts.audit_pool = &pool;
  parts.metrics = &metrics;
  MissionHost host(std::move(parts), {});
  absl::Notification driven;
  ASSERT_TRUE(host.Post([&](MissionWriter& writer) {
                    MissionConduct& conduct = writer.conduct();
                    EXPECT_TRUE(conduct.Register({"r1", 0.2, 7}).ok());
                    EXPECT_TRUE(conduct.Ingest("r1", 7, RoomRunBatch()).status.ok());
                    EXPECT_GT(writer.mission().Snapshot()->gas_quality.epochs, 0);
                    driven.Notify();
                  })
                  .ok());
  driven.WaitForNotification();
  quiet.Notify();
  const SteadyTime patience = After(SteadyNow(), absl::Seconds(60));
  const auto is_counted = [&] {
    return prometheus::TextSerializer()
               .Serialize(registry.Collect())
               .find("plumescout_gas_audits_total{outcome=\"certified\"} 1\n") != std::string::npos;
  };
  while (!is_counted() && SteadyNow() < patience) absl::SleepFor(absl::Milliseconds(1));
  EXPECT_TRUE(is_counted());
}

}  // namespace mission_host_audit_test
}  // namespace plumescout::server
