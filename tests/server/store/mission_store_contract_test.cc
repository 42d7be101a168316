// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// What every MissionStore promises, tried on each engine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>
#include <ostream>
#include <thread>

#include "core/types/error_reason.h"
#include "server/open_store.h"
#include "server/store/sqlite_store.h"
#include "tests/server/store/store_work.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/memory_store.h"
#include "tests/support/postgres_server.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace mission_store_contract_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct StoreKind {
  std::string name;
  std::function<std::unique_ptr<MissionStore>(const std::string& folder)> make;

  friend std::ostream& operator<<(std::ostream& out, const StoreKind& kind) {
    return out << kind.name;
  }
};

class MissionStoreContract : public ::testing::TestWithParam<StoreKind> {
 protected:
  MissionStore& store() { return *store_; }
  void Close() { store_ = nullptr; }

  // A mission with records 1 to `count`, under epoch 1.
  void Fill(const std::string& key, int count) {
    ASSERT_TRUE(store().Create(key, "header of " + key).ok());
    ASSERT_TRUE(AppendNow(store(), key, 1, 1, Records(key, 1, count)).ok());
  }

 private:
  const TempFolder folder_;
  const FaultyDisk disk_;  // so that nothing waits for syncs
  std::unique_ptr<MissionStore> store_ = GetParam().make(folder_.path());
};

TEST_P(MissionStoreContract, AMissionIsMadeOnce) {
  const auto epoch = store().Create("house", "of bricks");
  ASSERT_TRUE(epoch.ok()) << epoch.status();
  EXPECT_EQ(*epoch, 1);

  const absl::Status again = store().Create("house", "of straw").status();
  EXPECT_TRUE(absl::IsAlreadyExists(again));
  EXPECT_EQ(ErrorReason(again), reason::kMissionExists);
  EXPECT_EQ(store().Peek("house")->header, "of bricks");
}

TEST_P(MissionStoreContract, WhatIsWholeIsNotDiscarded) {
  Fill("house", 2);
  EXPECT_TRUE(absl::IsFailedPrecondition(DiscardNow(store(), "house")));
  EXPECT_EQ(store().Peek("house")->head, 2);
}

TEST_P(MissionStoreContract, WhatIsNotThereIsNotFound) {
  for (const absl::Status& status :
       {store().Acquire("house").status(), store().Peek("house").status(),
        store().Read("house", 1).status(), AppendNow(store(), "house", 1, 1, {"a"}),
        PutStandingNow(store(), "house", 1, "paused"),
        PutSnapshotNow(store(), "house", 1, {0, 0, ""}), TrimNow(store(), "house", 1),
        RemoveNow(store(), "house", 1), DiscardNow(store(), "house")}) {
    EXPECT_TRUE(absl::IsNotFound(status)) << status;
    EXPECT_EQ(ErrorReason(status), reason::kMissionNotFound);
  }
  EXPECT_THAT(*store().List(), IsEmpty());
}

TEST_P(MissionStoreContract, RecordsAreReadAsTheyWereAppended) {
  ASSERT_TRUE(store().Create("house", "").ok());
  const std::string zeros(3, '\0');
  ASSERT_TRUE(AppendNow(store(), "house", 1, 1, {"a", "", zeros}).ok());
  ASSERT_TRUE(AppendNow(store(), "house", 1, 4, {}).ok());
  ASSERT_TRUE(AppendNow(store(), "house", 1, 4, {"d"}).ok());

  const std::vector<JournalRecord> all = {{1, "a"}, {2, ""}, {3, zeros}, {4, "d"}};
  EXPECT_EQ(*ReadAll(store(), "house"), all);
  EXPECT_THAT(*ReadAll(store(), "house", 4), ElementsAre(JournalRecord{4, "d"}));
  EXPECT_THAT(*ReadAll(store(), "house", 5), IsEmpty());
  EXPECT_THAT(*ReadAll(store(), "house", 500), IsEmpty());
  EXPECT_TRUE(absl::IsInvalidArgument(store().Read("house", 0).status()));
}

TEST_P(MissionStoreContract, ManyRecordsAreReadInPages) {
  constexpr int kCount = 1500;
  Fill("house", kCount);
  EXPECT_EQ(*ReadAll(store(), "house"), Numbered("house", 1, kCount));
  EXPECT_EQ(*ReadAll(store(), "house", 700), Numbered("house", 700, kCount - 699));
}

TEST_P(MissionStoreContract, AReaderEndsWhereTheJournalEndedWhenItBegan) {
  Fill("house", 3);
  const auto reader = store().Read("house", 3);
  ASSERT_TRUE(AppendNow(store(), "house", 1, 4, {"more"}).ok());
  EXPECT_EQ((**(*reader)->Next()).number, 3);
  EXPECT_FALSE((*reader)->Next()->has_value());
  EXPECT_FALSE((*reader)->Next()->has_value());
}

TEST_P(MissionStoreContract, RecordsGoThatTwoSnapshotsStandFor) {
  Fill("house", 10);
  Fill("mill", 10);
  const std::int64_t whole_bytes = store().List()->front().bytes;
  ASSERT_TRUE(PutSnapshotNow(store(), "house", 1, {4, 0, "four"}).ok());
  ASSERT_TRUE(TrimNow(store(), "house", 1).ok());
  EXPECT_EQ(store().Peek("house")->first, 1) << "one snapshot may turn out to be damaged";

  ASSERT_TRUE(PutSnapshotNow(store(), "house", 1, {7, 0, "seven"}).ok());
  for (int times = 0; times < 2; ++times) {
    ASSERT_TRUE(TrimNow(store(), "house", 1).ok());
    EXPECT_EQ(store().Peek("house")->first, 5);
    EXPECT_TRUE(absl::IsOutOfRange(store().Read("house", 1).status()));
    EXPECT_TRUE(absl::IsOutOfRange(store().Read("house", 4).status()));
    EXPECT_EQ(*ReadAll(store(), "house", 5), Numbered("house", 5, 6));
    EXPECT_EQ(store().List()->front().bytes, whole_bytes - 4 * 40 + 9);
  }
  EXPECT_EQ(*ReadAll(store(), "mill"), Numbered("mill", 1, 10));

  ASSERT_TRUE(AppendNow(store(), "house", 1, 11, {RecordBytes("house", 11)}).ok());
  EXPECT_EQ(store().Acquire("house")->first, 5);
  EXPECT_EQ(*ReadAll(store(), "house", 8), Numbered("house", 8, 4));
  EXPECT_EQ(ErrorReason(TrimNow(store(), "house", 1)), reason::kFenced);
}

TEST_P(MissionStoreContract, AReaderHearsThatWhatItHasNotReadYetIsTrimmed) {
  Fill("house", 1000);
  const auto reader = store().Read("house", 1).value();
  ASSERT_TRUE(PutSnapshotNow(store(), "house", 1, {900, 0, ""}).ok());
  ASSERT_TRUE(PutSnapshotNow(store(), "house", 1, {950, 0, ""}).ok());
  ASSERT_TRUE(TrimNow(store(), "house", 1).ok());
  // They are deleted step by step, in turn with what is asked for.
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(PutStandingNow(store(), "house", 1, "").ok());
  absl::Status end;
  for (int i = 0; i < 1000 && end.ok(); ++i) end = reader->Next().status();
  EXPECT_TRUE(absl::IsOutOfRange(end)) << end;
}

TEST_P(MissionStoreContract, GapsAndRepetitionsAreRefused) {
  Fill("house", 3);
  for (const std::int64_t first : {-1, 0, 1, 3, 5}) {
    const absl::Status status = AppendNow(store(), "house", 1, first, {"x"});
    EXPECT_EQ(ErrorReason(status), reason::kFenced) << first << ": " << status;
  }
  EXPECT_EQ(*ReadAll(store(), "house"), Numbered("house", 1, 3));
}

TEST_P(MissionStoreContract, WhoAcquiresFencesTheOthers) {
  Fill("house", 3);
  const auto taken = store().Acquire("house");
  ASSERT_TRUE(taken.ok()) << taken.status();
  EXPECT_EQ(taken->epoch, 2);
  EXPECT_EQ(taken->head, 3);
  EXPECT_EQ(taken->header, "header of house");
  EXPECT_EQ(taken->standing, "");
  EXPECT_THAT(taken->snapshots, IsEmpty());

  for (const std::int64_t epoch : {0, 1, 3}) {
    for (const absl::Status& status : {AppendNow(store(), "house", epoch, 4, {"x"}),
                                       PutStandingNow(store(), "house", epoch, "x"),
                                       PutSnapshotNow(store(), "house", epoch, {1, 1, "x"}),
                                       RemoveNow(store(), "house", epoch)}) {
      EXPECT_EQ(ErrorReason(status), reason::kFenced) << status;
    }
  }
  EXPECT_TRUE(AppendNow(store(), "house", 2, 4, {"d"}).ok());
  EXPECT_EQ(store().Acquire("house")->epoch, 3);
  EXPECT_EQ(store().Peek("house")->epoch, 3);
}

TEST_P(MissionStoreContract, StandingIsReplaced) {
  Fill("house", 1);
  EXPECT_TRUE(PutStandingNow(store(), "house", 1, "paused").ok());
  EXPECT_TRUE(PutStandingNow(store(), "house", 1, "finished").ok());
  EXPECT_EQ(store().Peek("house")->standing, "finished");
  EXPECT_EQ(store().Acquire("house")->standing, "finished");
}

TEST_P(MissionStoreContract, TheNewestTwoSnapshotsAreKept) {
  Fill("house", 5);
  EXPECT_TRUE(absl::IsInvalidArgument(PutSnapshotNow(store(), "house", 1, {6, 0, "ahead"})));
  for (const std::int64_t revision : {1, 4, 3, 1, 5, 5}) {
    const std::string bytes = absl::StrCat("state ", revision);
    EXPECT_TRUE(PutSnapshotNow(store(), "house", 1, {revision, ~std::uint64_t{0}, bytes}).ok());
  }
  EXPECT_THAT(store().Acquire("house")->snapshots,
              ElementsAre(StoredSnapshot{5, ~std::uint64_t{0}, "state 5"},
                          StoredSnapshot{4, ~std::uint64_t{0}, "state 4"}));
}

TEST_P(MissionStoreContract, ListsSayHowFarAndHowLarge) {
  ASSERT_TRUE(store().Create("mill", std::string(100, 'h')).ok());
  ASSERT_TRUE(store().Create("barn/7", "").ok());
  EXPECT_THAT(*store().List(),
              ElementsAre(StoredMission{"barn/7", 1, 0, 0}, StoredMission{"mill", 1, 0, 100}));

  ASSERT_TRUE(AppendNow(store(), "mill", 1, 1, {"12345", "678"}).ok());
  ASSERT_TRUE(PutStandingNow(store(), "mill", 1, "first").ok());
  ASSERT_TRUE(PutStandingNow(store(), "mill", 1, "paused").ok());
  for (const std::int64_t revision : {0, 1, 2, 2}) {
    ASSERT_TRUE(PutSnapshotNow(store(), "mill", 1, {revision, 0, std::string(50, 's')}).ok());
  }
  ASSERT_TRUE(store().Acquire("mill").ok());
  EXPECT_THAT(*store().List(),
              ElementsAre(StoredMission{"barn/7", 1, 0, 0},
                          StoredMission{"mill", 2, 2, 100 + 8 + 6 + 2 * 50, false, "paused"}));
}

TEST_P(MissionStoreContract, WhatIsRemovedIsGoneAndMayBeMadeAnew) {
  Fill("house", 30);
  Fill("mill", 3);
  ASSERT_TRUE(PutSnapshotNow(store(), "house", 1, {30, 1, "state"}).ok());
  ASSERT_TRUE(PutStandingNow(store(), "house", 1, "paused").ok());

  EXPECT_TRUE(RemoveNow(store(), "house", 1).ok());

  EXPECT_TRUE(absl::IsNotFound(store().Acquire("house").status()));
  EXPECT_TRUE(absl::IsNotFound(store().Read("house", 1).status()));
  EXPECT_EQ(store().List()->size(), 1U);
  ASSERT_EQ(*store().Create("house", "new"), 1);
  EXPECT_THAT(*ReadAll(store(), "house"), IsEmpty());
  EXPECT_EQ(store().Peek("house")->standing, "");
  ASSERT_TRUE(AppendNow(store(), "house", 1, 1, {"first"}).ok());
  EXPECT_THAT(store().Acquire("house")->snapshots, IsEmpty());
  EXPECT_EQ(*ReadAll(store(), "mill"), Numbered("mill", 1, 3));
}

TEST_P(MissionStoreContract, CallbacksComeInOrderAndWithoutLocks) {
  Fill("house", 1);
  std::vector<int> heard;
  Told last;
  for (int i = 0; i < 100; ++i) {
    store().Append("house", 1, 2 + i, {"x"}, [&, i](const absl::Status& status) {
      EXPECT_TRUE(status.ok()) << status;
      EXPECT_GE(store().state().backlog_records, 0);  // may be called from here
      heard.push_back(i);
    });
  }
  store().PutStanding("house", 1, "paused", last.done());
  EXPECT_TRUE(last.Wait().ok());
  ASSERT_EQ(heard.size(), 100U);
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
}

TEST_P(MissionStoreContract, NothingIsBehindOnceAllIsDurable) {
  Fill("house", 100);
  const StoreState state = store().state();
  EXPECT_TRUE(state.status.ok());
  EXPECT_EQ(state.backlog_bytes, 0);
  EXPECT_EQ(state.backlog_records, 0);
  EXPECT_GE(state.commits, 2);
  EXPECT_GE(state.last_commit, absl::ZeroDuration());
}

TEST_P(MissionStoreContract, ManyThreadsWriteManyMissions) {
  constexpr int kThreads = 8;
  constexpr int kMissions = 20;
  constexpr int kAppends = 12;
  const auto key_of = [](int mission) { return absl::StrCat("m", mission); };
  for (int i = 0; i < kMissions; ++i) ASSERT_TRUE(store().Create(key_of(i), "").ok());
  std::atomic<int> told = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      // Each thread has missions of its own, and writes to them in turns.
      for (int i = 0; i < kAppends; ++i) {
        for (int mission = t; mission < kMissions; mission += kThreads) {
          store().Append(key_of(mission), 1, 1 + 3 * i, Records(key_of(mission), 1 + 3 * i, 3),
                         [&](const absl::Status& status) { told += status.ok() ? 1 : 0; });
        }
      }
      EXPECT_TRUE(store().List().ok());
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < kMissions; ++i) ASSERT_TRUE(PutStandingNow(store(), key_of(i), 1, "").ok());
  EXPECT_EQ(told, kMissions * kAppends);
  for (int i = 0; i < kMissions; ++i) {
    EXPECT_EQ(*ReadAll(store(), key_of(i)), Numbered(key_of(i), 1, 3 * kAppends));
  }
}

TEST_P(MissionStoreContract, WhoIsClosedAnswersEverybodyOnce) {
  Fill("house", 1);
  constexpr int kAppends = 200;
  std::vector<std::atomic<int>> answers(kAppends);
  absl::Notification begun;
  for (int i = 0; i < kAppends; ++i) {
    store().Append("house", 1, 2 + i, {"x"}, [&, i](const absl::Status& status) {
      ++answers[static_cast<std::size_t>(i)];
      EXPECT_TRUE(status.ok() || absl::IsCancelled(status)) << status;
      if (i == 0) begun.WaitForNotification();
    });
  }
  std::thread closing([&] { Close(); });
  begun.Notify();
  closing.join();
  for (const std::atomic<int>& count : answers) EXPECT_EQ(count, 1);
}

std::unique_ptr<MissionStore> OpenShared() {
  StoreConfig config;
  config.engine = kPostgresqlStore;
  config.url = PostgresServer::Shared().NewUrl();
  config.node = "n1";
  config.lease_s = 60;
  return OpenStore(config).value();
}

std::vector<StoreKind> Kinds() {
  std::vector<StoreKind> kinds = {
      {"Memory",
       [](const std::string&) -> std::unique_ptr<MissionStore> {
         return std::make_unique<MemoryStore>();
       }},
      {"Sqlite", [](const std::string& folder) -> std::unique_ptr<MissionStore> {
         return SqliteStore::Open(InFolder(folder)).value();
       }}};
  if (HasPostgresql()) {
    kinds.push_back({"Postgresql", [](const std::string&) { return OpenShared(); }});
  }
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Engines, MissionStoreContract, ::testing::ValuesIn(Kinds()),
                         [](const ::testing::TestParamInfo<StoreKind>& info) {
                           return info.param.name;
                         });

}  // namespace mission_store_contract_test
}  // namespace plumescout::server
