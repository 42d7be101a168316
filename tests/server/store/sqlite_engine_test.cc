// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// A disk that fails at any one step, or from there on: nothing that was told durable is lost, and
// nothing half-done is believed.
#include "server/store/sqlite_engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "core/types/error_reason.h"
#include "server/store/verify.h"
#include "tests/server/store/store_work.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace sqlite_engine_test {

constexpr int kRounds = 6;
constexpr int kRecords = 3;  // of each mission in each round

struct Fault {
  DiskFault kind = DiskFault::kFull;
  bool for_ever = false;
};

constexpr Fault kFaults[] = {{DiskFault::kFull, false},
                             {DiskFault::kFull, true},
                             {DiskFault::kIoError, false},
                             {DiskFault::kIoError, true}};

// What one mission was asked to keep, and what of it was told durable.
struct Expected {
  bool is_made = false;
  std::int64_t asked_head = 0;
  std::int64_t durable_head = 0;
  std::string asked_standing;
  std::string durable_standing;
};

// Two missions, written to while the disk fails. If it fails for ever, the work ends there.
class WorkUnderFault {
 public:
  WorkUnderFault(std::string folder, bool for_ever)
      : folder_(std::move(folder)), for_ever_(for_ever) {}

  void Run() {
    StoreOptions options = InFolder(folder_);
    options.warn = [this](absl::string_view) {
      absl::MutexLock lock(&mutex_);
      refused_ = for_ever_;
    };
    if (!Open(options)) return;
    for (const char* key : {"house", "mill"}) {
      if (!Make(key)) return;
    }
    for (int round = 0; round < kRounds; ++round) {
      for (auto& [key, mission] : missions_) Append(key, mission);
      if (round == 2) PutSnapshot();
      if (round == 3) PutStanding();
      if (!Wait()) break;
    }
    store_ = nullptr;  // tells the others that they are not durable
  }

  // Of a disk that is well again.
  void Check() {
    auto store = SqliteStore::Open(InFolder(folder_));
    ASSERT_TRUE(store.ok()) << store.status();
    for (const auto& [key, mission] : missions_) {
      const auto found = (*store)->Acquire(key);
      if (!mission.is_made && absl::IsNotFound(found.status())) continue;
      ASSERT_TRUE(found.ok()) << found.status();
      EXPECT_GE(found->head, mission.durable_head);
      EXPECT_LE(found->head, mission.asked_head);
      EXPECT_EQ(*ReadAll(**store, key), Numbered(key, 1, static_cast<int>(found->head)));
      EXPECT_TRUE(found->standing == mission.durable_standing ||
                  found->standing == mission.asked_standing);
      // And it goes on.
      EXPECT_TRUE(AppendNow(**store, key, found->epoch, found->head + 1, {"more"}).ok());
    }
    *store = nullptr;
    const auto report = VerifyStore(folder_);
    ASSERT_TRUE(report.ok()) << report.status();
    EXPECT_TRUE(report->is_whole());
    if (for_ever_) return;
    for (const auto& [key, mission] : missions_)
      EXPECT_EQ(mission.durable_head, kRounds * kRecords);
  }

 private:
  bool Open(const StoreOptions& options) {
    for (int attempt = 0; attempt < (for_ever_ ? 1 : 2); ++attempt) {
      auto opened = SqliteStore::Open(options);
      if (opened.ok()) {
        store_ = *std::move(opened);
        return true;
      }
      EXPECT_EQ(ErrorReason(opened.status()), reason::kStoreUnavailable) << opened.status();
    }
    EXPECT_TRUE(for_ever_);
    return false;
  }

  bool Make(const std::string& key) {
    Expected& mission = missions_[key];
    for (int attempt = 0; attempt < (for_ever_ ? 1 : 2) && !mission.is_made; ++attempt) {
      const absl::Status status = store_->Create(key, "header").status();
      mission.is_made = status.ok();
      EXPECT_TRUE(status.ok() || absl::IsUnavailable(status)) << status;
    }
    EXPECT_TRUE(mission.is_made || for_ever_);
    if (!mission.is_made) store_ = nullptr;
    return mission.is_made;
  }

  void Append(const std::string& key, Expected& mission) {
    const std::int64_t first = mission.asked_head + 1;
    mission.asked_head += kRecords;
    Note();
    store_->Append(key, 1, first, Records(key, first, kRecords),
                   [this, &mission, last = mission.asked_head](const absl::Status& status) {
                     EXPECT_TRUE(status.ok() || (for_ever_ && absl::IsCancelled(status))) << status;
                     if (status.ok()) mission.durable_head = last;
                     Answered();
                   });
  }

  void PutSnapshot() {
    Note();
    store_->PutSnapshot("house", 1, {2, 9, std::string(40'000, 's')},
                        [this](const absl::Status&) { Answered(); });
  }

  void PutStanding() {
    Expected& mission = missions_["mill"];
    mission.asked_standing = "paused";
    Note();
    store_->PutStanding("mill", 1, "paused", [this, &mission](const absl::Status& status) {
      if (status.ok()) mission.durable_standing = "paused";
      Answered();
    });
  }

  void Note() {
    absl::MutexLock lock(&mutex_);
    ++pending_;
  }
  void Answered() {
    absl::MutexLock lock(&mutex_);
    --pending_;
  }
  // False: the disk is gone.
  bool Wait() {
    absl::MutexLock lock(&mutex_);
    const auto done = [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
      return pending_ == 0 || refused_;
    };
    mutex_.Await(absl::Condition(&done));
    return !refused_;
  }

  const std::string folder_;
  const bool for_ever_;
  absl::Mutex mutex_;
  int pending_ ABSL_GUARDED_BY(mutex_) = 0;
  bool refused_ ABSL_GUARDED_BY(mutex_) = false;
  std::map<std::string, Expected> missions_;
  std::unique_ptr<SqliteStore> store_;
};

TEST(SqliteEngine, NothingDurableIsLostWhateverStepFails) {
  const TempFolder folder;
  const std::string made = folder.File("made");
  const std::string tried = folder.File("tried");
  FaultyDisk disk;
  ASSERT_TRUE(SqliteStore::Open(InFolder(made)).ok());  // making one syncs, which takes its time
  int points = 0;
  for (const Fault& fault : kFaults) {
    for (int step = 0; true; ++step) {
      SCOPED_TRACE(absl::StrCat("fault ", static_cast<int>(fault.kind), ", step ", step,
                                fault.for_ever ? " and all others" : ""));
      CopyStore(made, tried);
      WorkUnderFault work(tried, fault.for_ever);
      disk.FailAfter(step, fault.kind, fault.for_ever);
      work.Run();
      const bool has_failed = disk.has_failed();
      disk.Heal();
      work.Check();
      if (testing::Test::HasFailure()) return;
      if (!has_failed) break;
      ++points;
    }
  }
  EXPECT_GT(points, 200);
}

TEST(SqliteEngine, ARecoveryThatFailsMayBeRepeated) {
  const TempFolder folder;
  const std::string killed = folder.File("killed");
  const std::string tried = folder.File("tried");
  FaultyDisk disk;
  {
    const auto store = SqliteStore::Open(InFolder(folder.File("store"))).value();
    ASSERT_TRUE(store->Create("house", "header").ok());
    ASSERT_TRUE(AppendNow(*store, "house", 1, 1, Records("house", 1, 50)).ok());
    CopyStore(folder.File("store"), killed);
  }
  for (const Fault& fault : kFaults) {
    for (int step = 0; true; ++step) {
      SCOPED_TRACE(absl::StrCat("step ", step));
      CopyStore(killed, tried);
      disk.FailAfter(step, fault.kind, fault.for_ever);
      {
        auto store = SqliteStore::Open(InFolder(tried));
        const absl::Status status =
            store.ok() ? (*store)->Acquire("house").status() : store.status();
        EXPECT_TRUE(status.ok() || absl::IsUnavailable(status)) << status;
      }
      const bool has_failed = disk.has_failed();
      disk.Heal();
      const auto store = SqliteStore::Open(InFolder(tried)).value();
      const auto acquired = store->Acquire("house");
      ASSERT_TRUE(acquired.ok()) << acquired.status();
      EXPECT_EQ(*ReadAll(*store, "house"), Numbered("house", 1, 50));
      if (!has_failed) break;
    }
  }
}

}  // namespace sqlite_engine_test
}  // namespace plumescout::server
