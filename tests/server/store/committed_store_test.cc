// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/committed_store.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/server/store/store_work.h"

namespace plumescout::server {
namespace committed_store_test {

// Notes what it is asked for.
class NotingEngine final : public WriteEngine {
 public:
  explicit NotingEngine(std::vector<StoreWrite>* noted) : noted_(noted) {}

  absl::Status Commit(std::span<StoreWrite> writes) override {
    for (StoreWrite& write : writes) {
      if (write.acquired != nullptr) write.acquired->epoch = 7;
      noted_->push_back(write);
    }
    return absl::OkStatus();
  }

 private:
  std::vector<StoreWrite>* const noted_;
};

class NotingStore final : public CommittedStore {
 public:
  explicit NotingStore(std::vector<StoreWrite>* noted)
      : CommittedStore({}, std::make_unique<NotingEngine>(noted)) {}

  absl::StatusOr<std::unique_ptr<JournalReader>> Read(const std::string&, std::int64_t) override {
    return absl::UnimplementedError("no reading");
  }
  absl::StatusOr<AcquiredMission> Peek(const std::string&) override {
    return absl::UnimplementedError("no reading");
  }
  absl::StatusOr<std::vector<StoredMission>> List() override {
    return absl::UnimplementedError("no reading");
  }
  bool is_durable() const override { return true; }
};

TEST(CommittedStore, HandsOnWhatItIsAsked) {
  std::vector<StoreWrite> noted;
  NotingStore store(&noted);
  EXPECT_EQ(*store.Create("a", "header"), 1);
  EXPECT_EQ(store.Acquire("a")->epoch, 7);
  EXPECT_TRUE(AppendNow(store, "a", 2, 5, {"x", "y"}).ok());
  EXPECT_TRUE(PutStandingNow(store, "a", 2, "paused").ok());
  EXPECT_TRUE(PutSnapshotNow(store, "a", 2, {6, 9, "state"}).ok());
  EXPECT_TRUE(RemoveNow(store, "a", 2).ok());
  EXPECT_TRUE(DiscardNow(store, "a").ok());

  ASSERT_EQ(noted.size(), 7U);
  for (const StoreWrite& write : noted) EXPECT_EQ(write.key, "a");
  EXPECT_EQ(noted[0].kind, StoreWrite::Kind::kCreate);
  EXPECT_EQ(noted[0].bytes, "header");
  EXPECT_EQ(noted[1].kind, StoreWrite::Kind::kAcquire);
  EXPECT_EQ(noted[2].kind, StoreWrite::Kind::kAppend);
  EXPECT_EQ(noted[2].epoch, 2);
  EXPECT_EQ(noted[2].first_number, 5);
  EXPECT_EQ(noted[2].records, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(noted[3].kind, StoreWrite::Kind::kStanding);
  EXPECT_EQ(noted[3].bytes, "paused");
  EXPECT_EQ(noted[4].kind, StoreWrite::Kind::kSnapshot);
  EXPECT_EQ(noted[4].snapshot, (StoredSnapshot{6, 9, "state"}));
  EXPECT_EQ(noted[5].kind, StoreWrite::Kind::kRemove);
  EXPECT_EQ(noted[6].kind, StoreWrite::Kind::kDiscard);
  EXPECT_EQ(store.state().commits, 7);
}

}  // namespace committed_store_test
}  // namespace plumescout::server
