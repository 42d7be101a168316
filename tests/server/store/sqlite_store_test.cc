// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/sqlite_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "absl/strings/match.h"
#include "core/types/error_reason.h"
#include "formats/file_io.h"
#include "server/store/database.h"
#include "tests/server/store/store_work.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace sqlite_store_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class SqliteStoreTest : public ::testing::Test {
 protected:
  std::unique_ptr<SqliteStore> Open(StoreOptions options) {
    auto store = SqliteStore::Open(options);
    EXPECT_TRUE(store.ok()) << store.status();
    return store.ok() ? *std::move(store) : nullptr;
  }
  std::unique_ptr<SqliteStore> Open() { return Open(InFolder(folder_)); }

  const TempFolder temp_;
  const std::string folder_ = temp_.File("store");
  const std::string copy_ = temp_.File("copy");
  FaultyDisk disk_;
};

TEST_F(SqliteStoreTest, WhatWasWrittenIsThereAfterwards) {
  {
    const auto store = Open();
    ASSERT_TRUE(store->is_durable());
    ASSERT_TRUE(store->Create("house", "header").ok());
    ASSERT_TRUE(AppendNow(*store, "house", 1, 1, Records("house", 1, 20)).ok());
    ASSERT_TRUE(PutSnapshotNow(*store, "house", 1, {20, 7, "state"}).ok());
    ASSERT_TRUE(PutStandingNow(*store, "house", 1, "paused").ok());
    EXPECT_GT(store->disk_bytes(), 100'000);
  }
  const auto store = Open();
  const auto acquired = store->Acquire("house");
  ASSERT_TRUE(acquired.ok()) << acquired.status();
  EXPECT_EQ(acquired->epoch, 2);
  EXPECT_EQ(acquired->head, 20);
  EXPECT_EQ(acquired->header, "header");
  EXPECT_EQ(acquired->standing, "paused");
  EXPECT_THAT(acquired->snapshots, ElementsAre(StoredSnapshot{20, 7, "state"}));
  EXPECT_EQ(*ReadAll(*store, "house"), Numbered("house", 1, 20));
  EXPECT_TRUE(AppendNow(*store, "house", 2, 21, {"more"}).ok());
}

TEST_F(SqliteStoreTest, WhatAKilledProcessLeavesIsOpened) {
  const auto store = Open();
  ASSERT_TRUE(store->Create("house", "header").ok());
  ASSERT_TRUE(AppendNow(*store, "house", 1, 1, Records("house", 1, 20)).ok());
  CopyStore(folder_, copy_);
  const auto again = Open(InFolder(copy_));
  EXPECT_EQ(again->Acquire("house")->head, 20);
  EXPECT_EQ(*ReadAll(*again, "house"), Numbered("house", 1, 20));
}

TEST_F(SqliteStoreTest, ASecondServerIsRefused) {
  const auto store = Open();
  const absl::Status second = SqliteStore::Open(InFolder(folder_)).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(second)) << second;
  EXPECT_THAT(std::string(second.message()), HasSubstr("is in use by process "));
}

TEST_F(SqliteStoreTest, KeysAreBounded) {
  const auto store = Open();
  EXPECT_TRUE(absl::IsInvalidArgument(store->Create("", "").status()));
  EXPECT_TRUE(absl::IsInvalidArgument(store->Create(std::string(217, 'k'), "").status()));
  EXPECT_TRUE(store->Create(std::string(216, 'k'), "").ok());
}

TEST_F(SqliteStoreTest, ALogThatLostItsEndIsFoundOutAndMayBeAccepted) {
  {
    const auto store = Open();
    ASSERT_TRUE(store->Create("house", "header").ok());
    ASSERT_TRUE(store->Create("mill", "").ok());
    for (int i = 1; i <= 20; ++i) {
      ASSERT_TRUE(AppendNow(*store, "house", 1, i, Records("house", i, 1)).ok());
    }
    ASSERT_TRUE(store->Create("barn", "").ok());
    CopyStore(folder_, copy_);
  }
  const std::string log = copy_ + "/store.db-wal";
  std::filesystem::resize_file(log, std::filesystem::file_size(log) / 2);
  std::int64_t found = 0;
  {
    const auto store = Open(InFolder(copy_));
    const absl::Status damaged = store->Acquire("house").status();
    EXPECT_EQ(ErrorReason(damaged), reason::kStoreDamaged) << damaged;
    EXPECT_THAT(std::string(damaged.message()), HasSubstr(copy_ + "/store.db ends at record "));
    EXPECT_THAT(std::string(damaged.message()), HasSubstr("of record 20, epoch 1, "));
    EXPECT_EQ(ErrorReason(store->Peek("house").status()), reason::kStoreDamaged);
    EXPECT_EQ(ErrorReason(store->Read("house", 1).status()), reason::kStoreDamaged);
    EXPECT_TRUE(store->Acquire("mill").ok());
    // The one that is gone as a whole is not forgotten, nor made anew.
    EXPECT_THAT(*store->List(), SizeIs(3));
    EXPECT_EQ(ErrorReason(store->Acquire("barn").status()), reason::kStoreDamaged);
    EXPECT_EQ(ErrorReason(store->Create("barn", "").status()), reason::kStoreDamaged);
    EXPECT_EQ(ErrorReason(store->Read("barn", 1).status()), reason::kStoreDamaged);
  }
  StoreOptions options = InFolder(copy_);
  options.accept_loss = true;
  std::vector<std::string> warnings;
  options.warn = [&](absl::string_view what) { warnings.emplace_back(what); };
  {
    const auto store = Open(options);
    const auto acquired = store->Acquire("house");
    ASSERT_TRUE(acquired.ok()) << acquired.status();
    EXPECT_EQ(acquired->epoch, 2);
    found = acquired->head;
    EXPECT_GT(found, 0);
    EXPECT_LT(found, 20);
    EXPECT_TRUE(AppendNow(*store, "house", 2, found + 1, {"another"}).ok());
    EXPECT_TRUE(absl::IsNotFound(store->Acquire("barn").status()));
    EXPECT_TRUE(store->Create("barn", "").ok());
  }
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("mission barn"), HasSubstr("mission house")));
  EXPECT_EQ(Open(InFolder(copy_))->Acquire("house")->head, found + 1);
}

TEST_F(SqliteStoreTest, WhatIsDamagedIsDiscardedWhole) {
  for (const char* damage :
       {"UPDATE progress SET head = 4 WHERE head = 5", "DELETE FROM progress WHERE head = 5",
        "UPDATE mission SET header = x'00' WHERE key = 'house'",
        "DELETE FROM mission WHERE key = 'house'"}) {
    {
      const auto store = Open();
      ASSERT_TRUE(store->Create("house", "header").ok());
      ASSERT_TRUE(store->Create("mill", "header").ok());
      ASSERT_TRUE(AppendNow(*store, "house", 1, 1, Records("house", 1, 5)).ok());
    }
    {
      const auto database = Database::Open(folder_ + "/store.db", Database::Access::kWrite);
      ASSERT_TRUE(database.ok()) << database.status();
      ASSERT_TRUE((*database)->Execute(damage).ok()) << damage;
    }
    const auto store = Open();
    EXPECT_EQ(ErrorReason(store->Acquire("house").status()), reason::kStoreDamaged) << damage;
    EXPECT_TRUE(DiscardNow(*store, "house").ok()) << damage;
    EXPECT_TRUE(absl::IsNotFound(store->Peek("house").status()));
    EXPECT_TRUE(absl::IsNotFound(DiscardNow(*store, "house")));
    EXPECT_EQ(store->Peek("mill")->header, "header") << "others are whole";
    ASSERT_TRUE(RemoveNow(*store, "mill", 1).ok());
  }
}

TEST_F(SqliteStoreTest, AMissionThatWasRemovedStaysSoWithoutTheLog) {
  const auto store = Open();
  ASSERT_TRUE(store->Create("house", "header").ok());
  ASSERT_TRUE(AppendNow(*store, "house", 1, 1, Records("house", 1, 5)).ok());
  ASSERT_TRUE(RemoveNow(*store, "house", 1).ok());
  ASSERT_TRUE(store->Create("mill", "").ok());  // what follows the removal has been done
  CopyStore(folder_, copy_);
  const std::string log = copy_ + "/store.db-wal";
  ASSERT_GT(std::filesystem::file_size(log), 0);
  std::filesystem::resize_file(log, 0);
  const auto again = Open(InFolder(copy_));
  EXPECT_TRUE(absl::IsNotFound(again->Peek("house").status())) << again->Peek("house").status();
  EXPECT_EQ(ErrorReason(again->Peek("mill").status()), reason::kStoreDamaged);
}

TEST_F(SqliteStoreTest, AnOldCopyIsFoundOut) {
  {
    const auto store = Open();
    ASSERT_TRUE(store->Create("house", "header").ok());
    ASSERT_TRUE(AppendNow(*store, "house", 1, 1, Records("house", 1, 5)).ok());
  }
  CopyStore(folder_, copy_);
  {
    const auto store = Open();
    ASSERT_EQ(store->Acquire("house")->epoch, 2);
    ASSERT_TRUE(AppendNow(*store, "house", 2, 6, Records("house", 6, 5)).ok());
  }
  std::filesystem::copy_file(copy_ + "/store.db", folder_ + "/store.db",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(ErrorReason(Open()->Acquire("house").status()), reason::kStoreDamaged);
  StoreOptions options = InFolder(folder_);
  options.accept_loss = true;
  // No epoch that was given out is given out again.
  EXPECT_EQ(Open(options)->Acquire("house")->epoch, 3);
}

TEST_F(SqliteStoreTest, ADatabaseThatIsGoneIsMissed) {
  {
    const auto store = Open();
    ASSERT_TRUE(store->Create("house", "header").ok());
  }
  std::filesystem::remove(folder_ + "/store.db");
  const auto store = Open();
  EXPECT_THAT(*store->List(), ElementsAre(StoredMission{"house", 1, 0, 0}));
  EXPECT_EQ(ErrorReason(store->Acquire("house").status()), reason::kStoreDamaged);
}

TEST_F(SqliteStoreTest, MarksThatAreGoneAreMadeAnew) {
  {
    const auto store = Open();
    ASSERT_TRUE(store->Create("house", "header").ok());
  }
  std::filesystem::remove(folder_ + "/heads");
  EXPECT_EQ(Open()->Acquire("house")->epoch, 2);
  EXPECT_EQ(Open()->Acquire("house")->epoch, 3);
  EXPECT_FALSE(ReadFile(folder_ + "/heads", 1 << 20)->empty());
}

TEST_F(SqliteStoreTest, FilesOfOthersAreLeftAlone) {
  std::filesystem::create_directories(folder_);
  const std::string text = "this is no database of anybody";
  ASSERT_TRUE(WriteFile(folder_ + "/store.db", text).ok());
  const absl::Status status = SqliteStore::Open(InFolder(folder_)).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_EQ(*ReadFile(folder_ + "/store.db", 1000), text);
}

TEST_F(SqliteStoreTest, RoomOfRemovedMissionsIsGivenBack) {
  const auto store = Open();
  ASSERT_TRUE(store->Create("house", "").ok());
  ASSERT_TRUE(store->Create("mill", "").ok());
  ASSERT_TRUE(AppendNow(*store, "mill", 1, 1, Records("mill", 1, 100)).ok());
  ASSERT_TRUE(AppendNow(*store, "house", 1, 1, Records("house", 1, 1200, 1000)).ok());
  ASSERT_TRUE(store->Compact().ok());
  const std::int64_t before = store->disk_bytes();
  EXPECT_GT(before, 1'200'000);
  ASSERT_TRUE(RemoveNow(*store, "house", 1).ok());
  // Chores take turns with what is asked for: 500 records each.
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(PutStandingNow(*store, "mill", 1, "x").ok());
  ASSERT_TRUE(store->Compact().ok());
  EXPECT_LT(store->disk_bytes(), before - 900'000);
  EXPECT_EQ(*ReadAll(*store, "mill"), Numbered("mill", 1, 100));
}

TEST_F(SqliteStoreTest, ALongLogIsBroughtIntoTheDatabase) {
  const auto store = Open();
  ASSERT_TRUE(store->Create("house", "").ok());
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(
        AppendNow(*store, "house", 1, 1 + 100 * i, Records("house", 1 + 100 * i, 100, 10'000))
            .ok());
  }
  ASSERT_TRUE(AppendNow(*store, "house", 1, 3001, {"last"}).ok());
  // 30 MB in a log of 16 MB.
  EXPECT_LT(std::filesystem::file_size(folder_ + "/store.db-wal"), 25'000'000U);
  EXPECT_GT(std::filesystem::file_size(folder_ + "/store.db"), 16'000'000U);
}

TEST_F(SqliteStoreTest, AFullDiskIsWaitedForAndSaidOf) {
  StoreOptions options = InFolder(folder_);
  absl::Notification refused;
  absl::Notification works_again;
  options.warn = [&](absl::string_view what) {
    if (absl::StrContains(what, "full")) refused.Notify();
    if (what == "the store works again") works_again.Notify();
  };
  const auto store = Open(options);
  ASSERT_TRUE(store->Create("house", "").ok());
  disk_.FailAfter(0, DiskFault::kFull, /*for_ever=*/true);
  Told first;
  Told second;
  store->Append("house", 1, 1, {"1"}, first.done());
  store->Append("house", 1, 2, {"2"}, second.done());
  refused.WaitForNotification();

  const StoreState state = store->state();
  EXPECT_EQ(ErrorReason(state.status), reason::kStoreUnavailable);
  EXPECT_THAT(std::string(state.status.message()), HasSubstr(folder_ + "/store.db"));
  EXPECT_GE(state.backlog_bytes, 1);
  EXPECT_FALSE(first.is_told() || second.is_told());
  EXPECT_TRUE(absl::IsUnavailable(store->Create("mill", "").status()));
  EXPECT_THAT(*ReadAll(*store, "house"), IsEmpty());  // reading goes on

  disk_.Heal();
  EXPECT_TRUE(first.Wait().ok());
  EXPECT_TRUE(second.Wait().ok());
  works_again.WaitForNotification();
  EXPECT_TRUE(store->state().status.ok());
  EXPECT_THAT(*ReadAll(*store, "house"), SizeIs(2));
}

TEST_F(SqliteStoreTest, WhatWaitsForTheDiskIsCancelledInTheEnd) {
  Told answer;
  {
    const auto store = Open();
    ASSERT_TRUE(store->Create("house", "").ok());
    disk_.FailAfter(0, DiskFault::kFull, /*for_ever=*/true);
    store->Append("house", 1, 1, {"1"}, answer.done());
  }
  EXPECT_TRUE(absl::IsCancelled(answer.Wait()));
  disk_.Heal();
  EXPECT_EQ(Open()->Acquire("house")->head, 0);
}

}  // namespace sqlite_store_test
}  // namespace plumescout::server
