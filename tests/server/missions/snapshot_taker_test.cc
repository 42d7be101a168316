// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/snapshot_taker.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/server/held_store.h"
#include "tests/server/stored_run.h"

namespace plumescout::server {
namespace snapshot_taker_test {

constexpr char kKey[] = "hall";

class SnapshotTakerTest : public testing::Test {
 protected:
  SnapshotTakerTest() {
    const MissionOptions options = support::FastAgeing();
    EXPECT_TRUE(store_.Create(kKey, EncodeMissionStart({}, options)).ok());
    events_ = RoomRunEvents(options);
    journal_ =
        std::make_shared<MissionJournal>(JournalHome{.store = &store_, .key = kKey, .epoch = 1});
  }

  // Applies all events, of `bytes` each as far as the taker hears. Then everything is in the store.
  void Run(SnapshotTaker& taker, std::int64_t bytes) {
    Mission mission(support::FastAgeing());
    for (const Event& event : events_) {
      ASSERT_TRUE(mission.Apply(event.body).ok());
      journal_->Add(event);
      taker.NoteEvent(event, bytes, mission);
      journal_->Flush();
      cpu_ += per_event_;
    }
    ASSERT_TRUE(journal_->AwaitStored(SteadyTime::max()));
  }
  std::vector<StoredSnapshot> Snapshots() { return store_.Peek(kKey)->snapshots; }

  HeldStore store_;
  std::vector<Event> events_;
  std::shared_ptr<MissionJournal> journal_;
  absl::Duration cpu_;
  absl::Duration per_event_;
};

TEST_F(SnapshotTakerTest, ALongTailIsCutOffAndTheMissionComesOutTheSame) {
  {
    WorkerPool pool({"snapshot", 1, 8});
    SnapshotTaker taker(journal_, &pool, {}, [this] { return cpu_; });
    Run(taker, 100'000);
  }
  ASSERT_FALSE(Snapshots().empty());
  EXPECT_GT(Snapshots()[0].revision, 0);
  const auto recovered = RecoverMission(store_, kKey, NeverStop());
  ASSERT_TRUE(recovered.ok()) << recovered.status();
  EXPECT_GT(recovered->tail.snapshot_bytes, 0);
  Mission straight(support::FastAgeing());
  for (const Event& event : events_) ASSERT_TRUE(straight.Apply(event.body).ok());
  EXPECT_EQ(recovered->mission->Digest(), straight.Digest());
  ExpectSameMission(*recovered->mission->Snapshot(), *straight.Snapshot());
}

TEST_F(SnapshotTakerTest, AShortTailIsNot) {
  {
    WorkerPool pool({"snapshot", 1, 8});
    SnapshotTaker taker(journal_, &pool, {}, [this] { return cpu_; });
    Run(taker, 1);
  }
  EXPECT_TRUE(Snapshots().empty());
}

TEST_F(SnapshotTakerTest, OneThatTakesLongToReplayIs) {
  per_event_ = absl::Seconds(1);
  {
    WorkerPool pool({"snapshot", 1, 8});
    SnapshotTaker taker(journal_, &pool, {}, [this] { return cpu_; });
    Run(taker, 1);
  }
  EXPECT_FALSE(Snapshots().empty());
}

TEST_F(SnapshotTakerTest, WhatIsNotDurableIsNotKept) {
  {
    WorkerPool pool({"snapshot", 1, 8});
    SnapshotTaker taker(journal_, &pool, {}, [this] { return cpu_; });
    store_.Hold();
    Mission mission(support::FastAgeing());
    for (const Event& event : events_) {
      ASSERT_TRUE(mission.Apply(event.body).ok());
      journal_->Add(event);
      taker.NoteEvent(event, 100'000, mission);
    }
    journal_->Close(absl::UnavailableError("over"));
  }
  store_.Release();
  EXPECT_TRUE(Snapshots().empty());
}

TEST(ThreadCpuTest, Grows) {
  const absl::Duration before = ThreadCpuNow();
  while (ThreadCpuNow() == before) {
  }
  EXPECT_GT(ThreadCpuNow(), before);
}

}  // namespace snapshot_taker_test
}  // namespace plumescout::server
