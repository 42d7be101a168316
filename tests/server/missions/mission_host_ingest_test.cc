// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Of the mission host: what it does not let through to the conduct.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "absl/synchronization/notification.h"
#include "core/types/error_reason.h"
#include "server/missions/mission_host.h"
#include "tests/server/host_parts.h"

namespace plumescout::server {
namespace mission_host_ingest_test {

constexpr std::int64_t kLease = 7;

// Returns once every command posted before has run.
void Settle(MissionHost& host) {
  absl::Notification done;
  ASSERT_TRUE(host.Post([&](MissionWriter&) { done.Notify(); }).ok());
  done.WaitForNotification();
}

void AddRobot(MissionHost& host) {
  ASSERT_TRUE(host.Post([](MissionWriter& writer) {
                    EXPECT_TRUE(writer.conduct().Register({"r1", 0.2, kLease}).ok());
                  })
                  .ok());
}

void PostGas(MissionHost& host, std::int64_t first, std::int64_t last) {
  ASSERT_TRUE(host.Post([first, last](MissionWriter& writer) {
                    EXPECT_TRUE(
                        writer.conduct().Ingest("r1", kLease, GasBatch(first, last)).status.ok());
                  })
                  .ok());
}

TEST(MissionHostIngestTest, AFinishedMissionTakesNoBatch) {
  MissionHost host(HostParts(), {});
  AddRobot(host);
  PostGas(host, 1, 2);
  host.standing().Finish();
  ASSERT_TRUE(host.Post([&](MissionWriter& writer) {
                    const IngestResult result = host.Ingest(writer, "r1", kLease, GasBatch(3, 4));
                    EXPECT_EQ(ErrorReason(result.status), reason::kMissionFinished);
                    EXPECT_EQ(result.position.applied_sequence, 2);
                  })
                  .ok());
  Settle(host);
}

TEST(MissionHostIngestTest, ASampleOfAClockThatRunsAheadIsAnEventThatARefusalFollows) {
  HostOptions options;
  options.wall_clock = [] { return std::int64_t{1'000'000'000}; };
  options.max_clock_lead = absl::Seconds(1);
  std::vector<Event> events;
  MissionHost host(HostParts(nullptr, [&](const Event& event) { events.push_back(event); }),
                   options);
  AddRobot(host);
  ASSERT_TRUE(host.Post([&](MissionWriter& writer) {
                    auto batch = GasBatch(1, 3);
                    batch[1].observation.sample_time_ns = 2'000'000'001;
                    const IngestResult result = host.Ingest(writer, "r1", kLease, std::move(batch));
                    EXPECT_TRUE(result.status.ok()) << result.status;
                    EXPECT_EQ(result.position.applied_sequence, 3);
                    ASSERT_EQ(result.refused.size(), 1U);
                    EXPECT_EQ(ErrorReason(result.refused[0].status), reason::kClockAhead);
                  })
                  .ok());
  Settle(host);
  host.Stop(absl::NotFoundError("deleted"));
  Mission replay{MissionOptions{}};
  for (const Event& event : events) EXPECT_TRUE(replay.Apply(event.body).ok());
  EXPECT_EQ(replay.sample_time_ns(), 3'000'000);
  EXPECT_EQ(replay.AppliedSequence("r1").value(), 3);
}

}  // namespace mission_host_ingest_test
}  // namespace plumescout::server
