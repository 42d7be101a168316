// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "absl/synchronization/notification.h"
#include "core/types/error_reason.h"
#include "formats/journal/event_codec.h"
#include "tests/server/held_store.h"

namespace plumescout::server {
namespace mission_journal_test {

constexpr char kKey[] = "hall";

// Somebody who waits for the disk.
class Waiting {
 public:
  MissionJournal::Callback Callback() {
    return [this](const absl::Status& status) {
      status_ = status;
      told_.Notify();
    };
  }
  bool told() const { return told_.HasBeenNotified(); }
  const absl::Status& Await() const {
    told_.WaitForNotification();
    return status_;
  }

 private:
  absl::Notification told_;
  absl::Status status_;
};

class MissionJournalTest : public testing::Test {
 protected:
  MissionJournalTest() {
    const auto epoch = store_.Create(kKey, EncodeStart({}));
    EXPECT_TRUE(epoch.ok()) << epoch.status();
    journal_ = std::make_shared<MissionJournal>(JournalHome{
        .store = &store_, .key = kKey, .epoch = epoch.value_or(0), .max_backlog_bytes = 1000});
    store_.Hold();
  }
  ~MissionJournalTest() override { store_.Release(); }

  void AddGas(const RobotId& robot, std::int64_t sequence) {
    journal_->Add({++events_, ObservationReceived{robot, {sequence, 1, {}, GasReading{1.0, 0.0}}}});
  }
  // Returns once everything that was released is durable.
  void Settle() {
    ASSERT_EQ(store_.held(), 0);
    ASSERT_TRUE(journal_->AwaitStored(SteadyTime::max()));
  }
  absl::Status Durable(std::int64_t revision) {
    Waiting waiting;
    journal_->WhenDurable(revision, SteadyTime::max(), waiting.Callback());
    return waiting.Await();
  }

  HeldStore store_;
  std::shared_ptr<MissionJournal> journal_;
  std::int64_t events_ = 0;
};

TEST_F(MissionJournalTest, AnswersWaitForTheDisk) {
  AddGas("r1", 1);
  AddGas("r1", 2);
  journal_->Flush();
  Waiting first;
  Waiting second;
  journal_->WhenDurable(1, SteadyTime::max(), first.Callback());
  journal_->WhenDurable(2, SteadyTime::max(), second.Callback());
  EXPECT_EQ(store_.held(), 1) << "events leave in batches";
  EXPECT_FALSE(first.told() || second.told());
  EXPECT_EQ(journal_->durable_revision(), 0);
  store_.Release();
  EXPECT_TRUE(first.Await().ok());
  EXPECT_TRUE(second.Await().ok());
  EXPECT_EQ(journal_->durable_revision(), 2);
  EXPECT_TRUE(Durable(2).ok());
}

TEST_F(MissionJournalTest, WhatLeftIsWhatComesBack) {
  AddGas("r1", 1);
  AddGas("r2", 1);
  journal_->Flush();
  store_.Release();
  ASSERT_TRUE(Durable(2).ok());
  const auto reader = *store_.Read(kKey, 2);
  const std::optional<JournalRecord> record = *reader->Next();
  ASSERT_TRUE(record.has_value());
  const auto event = DecodeEvent(record->bytes);
  ASSERT_TRUE(event.ok()) << event.status();
  EXPECT_EQ(event->number, 2);
  EXPECT_EQ(std::get<ObservationReceived>(event->body).robot, "r2");
  EXPECT_FALSE((*reader->Next()).has_value());
}

TEST_F(MissionJournalTest, EachRobotHearsHowFarItsLogIsDurable) {
  AddGas("r1", 1);
  AddGas("r1", 2);
  AddGas("r2", 1);
  journal_->Flush();
  AddGas("r1", 3);
  AddGas("r2", 2);
  journal_->Flush();
  EXPECT_EQ(journal_->DurableSequence("r1", 3), 0);
  store_.ReleaseOne();
  ASSERT_TRUE(Durable(3).ok());
  EXPECT_EQ(journal_->DurableSequence("r1", 3), 2);
  EXPECT_EQ(journal_->DurableSequence("r2", 2), 1);
  store_.Release();
  Settle();
  EXPECT_EQ(journal_->DurableSequence("r1", 3), 3);
  EXPECT_EQ(journal_->DurableSequence("r3", 7), 7) << "what it sent before this life is durable";
}

TEST_F(MissionJournalTest, AGapIsDurableAsAWhole) {
  journal_->Add({++events_, ObservationReceived{"r1", {5, 1, {}, SequenceGap{5, 9}}}});
  journal_->Flush();
  EXPECT_EQ(journal_->DurableSequence("r1", 9), 4);
  store_.Release();
  Settle();
  EXPECT_EQ(journal_->DurableSequence("r1", 9), 9);
}

TEST_F(MissionJournalTest, BatchesGrowWhileTheDiskIsSlow) {
  AddGas("r1", 1);
  journal_->FlushIfIdle();
  EXPECT_EQ(store_.held(), 1);
  for (int i = 2; i < 100; ++i) {
    AddGas("r1", i);
    journal_->FlushIfIdle();
  }
  EXPECT_EQ(store_.held(), 1);
  store_.Hold();
  store_.ReleaseOne();
  ASSERT_TRUE(Durable(1).ok());
  ASSERT_TRUE(journal_->AwaitStored(SteadyTime::max()));
  AddGas("r1", 100);
  journal_->FlushIfIdle();
  EXPECT_EQ(store_.held(), 1);
  store_.Release();
  EXPECT_TRUE(Durable(100).ok());
}

TEST_F(MissionJournalTest, ManyEventsLeaveByThemselves) {
  for (int i = 1; i <= 450; ++i) AddGas("r1", i);
  EXPECT_EQ(store_.held(), 2);
}

TEST_F(MissionJournalTest, StandingIsWaitedForToo) {
  journal_->PutStanding("paused");
  Waiting waiting;
  journal_->WhenDurable(0, SteadyTime::max(), waiting.Callback());
  EXPECT_FALSE(waiting.told());
  store_.Release();
  EXPECT_TRUE(waiting.Await().ok());
  EXPECT_EQ(store_.Peek(kKey)->standing, "paused");
}

TEST_F(MissionJournalTest, NobodyWaitsBeyondTheDeadline) {
  const SteadyTime now = SteadyNow();
  AddGas("r1", 1);
  journal_->Flush();
  EXPECT_EQ(journal_->next_deadline(), SteadyTime::max());
  Waiting waiting;
  journal_->WhenDurable(1, now, waiting.Callback());
  EXPECT_EQ(journal_->next_deadline(), now);
  journal_->DropOverdue(now - std::chrono::seconds(1));
  EXPECT_FALSE(waiting.told());
  journal_->DropOverdue(now);
  EXPECT_EQ(ErrorReason(waiting.Await()), reason::kStoreUnavailable);
  EXPECT_EQ(journal_->next_deadline(), SteadyTime::max());
}

TEST_F(MissionJournalTest, ABacklogSlowsAndThenStops) {
  EXPECT_TRUE(journal_->CheckTakesMore().ok());
  EXPECT_EQ(journal_->WindowNow(128), 128);
  store_.set_state(WithBacklog(500));
  EXPECT_EQ(journal_->WindowNow(128), 128);
  store_.set_state(WithBacklog(750));
  EXPECT_EQ(journal_->WindowNow(128), 64);
  store_.set_state(WithBacklog(1000));
  EXPECT_EQ(journal_->WindowNow(128), 1) << "who may send nothing hears nothing";
  EXPECT_TRUE(journal_->CheckTakesMore().ok());
  store_.set_state(WithBacklog(1001));
  const absl::Status refused = journal_->CheckTakesMore();
  EXPECT_EQ(ErrorReason(refused), reason::kStoreUnavailable);
  EXPECT_TRUE(RetryAfter_ns(refused).has_value());
  store_.set_state({});
  EXPECT_TRUE(journal_->CheckTakesMore().ok());
}

TEST_F(MissionJournalTest, ADiskThatFailsIsNamed) {
  store_.set_state(Refusing("missions.db: no space"));
  const absl::Status refused = journal_->CheckTakesMore();
  EXPECT_EQ(ErrorReason(refused), reason::kStoreUnavailable);
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("missions.db: no space"));
}

TEST_F(MissionJournalTest, WhoIsFencedSaysSo) {
  store_.Release();
  ASSERT_TRUE(store_.Acquire(kKey).ok());
  Waiting lost;
  journal_->WhenLost(lost.Callback());
  AddGas("r1", 1);
  journal_->Flush();
  EXPECT_EQ(ErrorReason(Durable(1)), reason::kFenced);
  EXPECT_EQ(ErrorReason(lost.Await()), reason::kFenced);
  EXPECT_EQ(ErrorReason(journal_->CheckTakesMore()), reason::kFenced);
  EXPECT_EQ(journal_->DurableSequence("r1", 1), 0);
  Waiting late;
  journal_->WhenLost(late.Callback());
  EXPECT_TRUE(late.told());
}

TEST_F(MissionJournalTest, AfterTheEndNobodyWaitsButEventsAreStored) {
  AddGas("r1", 1);
  Waiting waiting;
  journal_->WhenDurable(1, SteadyTime::max(), waiting.Callback());
  journal_->Close(absl::NotFoundError("deleted"));
  EXPECT_TRUE(absl::IsNotFound(waiting.Await()));
  EXPECT_TRUE(absl::IsNotFound(Durable(1)));
  journal_->Flush();
  EXPECT_FALSE(journal_->AwaitStored(SteadyNow()));
  store_.Release();
  EXPECT_TRUE(journal_->AwaitStored(SteadyTime::max()));
  EXPECT_EQ(journal_->durable_revision(), 1);
}

TEST_F(MissionJournalTest, RemovedMissionsAreGone) {
  Waiting waiting;
  journal_->Remove(waiting.Callback());
  EXPECT_FALSE(waiting.told());
  store_.Release();
  EXPECT_TRUE(waiting.Await().ok());
  EXPECT_TRUE(absl::IsNotFound(store_.Peek(kKey).status()));
}

TEST(VolatileJournalTest, WithoutAStoreThereIsNothingToWaitFor) {
  const auto journal = std::make_shared<MissionJournal>();
  EXPECT_FALSE(journal->is_durable());
  journal->Add({1, ObservationReceived{"r1", {1, 1, {}, GasReading{1.0, 0.0}}}});
  journal->Flush();
  journal->PutStanding("paused");
  Waiting waiting;
  journal->WhenDurable(1, SteadyTime::max(), waiting.Callback());
  EXPECT_TRUE(waiting.told());
  EXPECT_TRUE(waiting.Await().ok());
  EXPECT_EQ(journal->DurableSequence("r1", 1), 0);
  EXPECT_EQ(journal->WindowNow(128), 128);
  EXPECT_TRUE(journal->CheckTakesMore().ok());
  EXPECT_TRUE(journal->AwaitStored(SteadyNow()));
  Waiting removed;
  journal->Remove(removed.Callback());
  EXPECT_TRUE(removed.Await().ok());
}

TEST(VolatileJournalTest, AStoreThatIsNotDurableIsNotWaitedFor) {
  MemoryStore store;
  const auto epoch = store.Create(kKey, EncodeStart({}));
  const auto journal = std::make_shared<MissionJournal>(
      JournalHome{.store = &store, .key = kKey, .epoch = epoch.value()});
  journal->Add({1, ObservationReceived{"r1", {1, 1, {}, GasReading{1.0, 0.0}}}});
  Waiting waiting;
  journal->WhenDurable(1, SteadyTime::max(), waiting.Callback());
  EXPECT_TRUE(waiting.told());
  EXPECT_EQ(journal->DurableSequence("r1", 1), 0);
}

TEST_F(MissionJournalTest, EventsGoWithTheSecondSnapshotIfTold) {
  store_.Release();
  for (const std::int64_t sequence : {1, 2, 3, 4}) AddGas("r1", sequence);
  journal_->Flush();
  Settle();
  const auto put = [this](std::int64_t revision) {
    Waiting waiting;
    journal_->PutSnapshot({revision, 0, "state"}, waiting.Callback());
    EXPECT_TRUE(waiting.Await().ok());
    return store_.Peek(kKey)->first;
  };
  EXPECT_EQ(put(1), 1);
  EXPECT_EQ(put(2), 1) << "all are kept unless told otherwise";
  journal_->set_trims(true);
  EXPECT_EQ(put(3), 3);
  journal_->set_trims(false);
  EXPECT_EQ(put(4), 3);
}

}  // namespace mission_journal_test
}  // namespace plumescout::server
