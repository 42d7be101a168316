// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_snapshot.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "absl/synchronization/notification.h"
#include "tests/server/stored_run.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace mission_snapshot_test {

// Of a run in a room, at its last epoch.
struct SavedRun {
  std::vector<Event> events;
  StoredSnapshot snapshot;
};

SavedRun MakeRun() {
  SavedRun run{RoomRunEvents(support::FastAgeing()), {}};
  Mission mission(support::FastAgeing());
  for (const Event& event : run.events) {
    EXPECT_TRUE(mission.Apply(event.body).ok());
    if (!std::holds_alternative<EpochAdopted>(event.body)) continue;
    run.snapshot = PackSnapshot(mission.revision(), mission.Digest(), *mission.SaveState());
  }
  EXPECT_GT(run.snapshot.revision, 0) << "no epoch was adopted";
  return run;
}

TEST(MissionSnapshotTest, MakesTheMissionThatItWasTakenOf) {
  const SavedRun run = MakeRun();
  const auto mission = RestoreSnapshot(run.snapshot, support::FastAgeing(), NeverStop());
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_EQ((*mission)->revision(), run.snapshot.revision);
  EXPECT_EQ((*mission)->Digest(), run.snapshot.digest);
}

TEST(MissionSnapshotTest, WhatWouldMakeAnotherIsRefused) {
  const SavedRun run = MakeRun();
  StoredSnapshot other = run.snapshot;
  ++other.digest;
  EXPECT_TRUE(
      absl::IsDataLoss(RestoreSnapshot(other, support::FastAgeing(), NeverStop()).status()));
  other = run.snapshot;
  ++other.revision;
  EXPECT_TRUE(
      absl::IsDataLoss(RestoreSnapshot(other, support::FastAgeing(), NeverStop()).status()));
  other = run.snapshot;
  other.bytes[other.bytes.size() / 2] ^= 1;
  EXPECT_TRUE(
      absl::IsDataLoss(RestoreSnapshot(other, support::FastAgeing(), NeverStop()).status()));
}

TEST(MissionSnapshotTest, ARecoveryFallsBackOnTheLog) {
  const SavedRun run = MakeRun();
  MemoryStore store(/*is_durable=*/true);
  PutMission(store, "hall", support::FastAgeing(), run.events);
  StoredSnapshot damaged = run.snapshot;
  ++damaged.digest;
  absl::Notification kept;
  store.PutSnapshot("hall", 1, damaged, [&](const absl::Status& status) {
    EXPECT_TRUE(status.ok()) << status;
    kept.Notify();
  });
  kept.WaitForNotification();
  const auto recovered = RecoverMission(store, "hall", NeverStop());
  ASSERT_TRUE(recovered.ok()) << recovered.status();
  EXPECT_EQ(recovered->tail.snapshot_bytes, 0);
  EXPECT_EQ(recovered->mission->revision(), static_cast<std::int64_t>(run.events.size()));
}

}  // namespace mission_snapshot_test
}  // namespace plumescout::server
