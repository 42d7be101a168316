// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_usage.h"

#include <gtest/gtest.h>

#include <thread>

#include "absl/synchronization/notification.h"
#include "tests/server/held_store.h"

namespace plumescout::server {
namespace store_usage_test {

// Waits until the sizes are so; the test's own deadline ends it else.
template <typename Condition>
StoreUsage::Sizes AwaitSizes(const StoreUsage& usage, const Condition& condition) {
  while (true) {
    StoreUsage::Sizes sizes = usage.sizes();
    if (condition(sizes)) return sizes;
    std::this_thread::yield();
  }
}

class SizedStore : public HeldStore {
 public:
  std::int64_t disk_bytes() const override { return 4096; }
};

// One that hangs, as a database on a network that is gone.
class HangingStore final : public SizedStore {
 public:
  absl::StatusOr<std::vector<StoredMission>> List() override {
    asked.Notify();
    answers.WaitForNotification();
    return SizedStore::List();
  }
  absl::Notification asked;
  absl::Notification answers;
};

TEST(StoreUsageTest, LooksAgainAndAgain) {
  SizedStore store;
  ASSERT_TRUE(store.Create("hall", "header").ok());
  const StoreUsage usage(&store, absl::Milliseconds(1));
  AwaitSizes(usage, [](const auto& sizes) { return sizes.mission_bytes.size() == 1; });
  ASSERT_TRUE(store.Create("acme/yard", "header").ok());
  const StoreUsage::Sizes both =
      AwaitSizes(usage, [](const auto& sizes) { return sizes.mission_bytes.size() == 2; });
  EXPECT_GT(both.mission_bytes.at("acme/yard"), 0);
  EXPECT_EQ(both.disk_bytes, 4096);
}

TEST(StoreUsageTest, NobodyWaitsForAStoreThatHangs) {
  HangingStore store;
  ASSERT_TRUE(store.Create("hall", "header").ok());
  {
    const StoreUsage usage(&store, absl::Hours(1));
    store.asked.WaitForNotification();
    EXPECT_TRUE(usage.sizes().mission_bytes.empty());
    store.answers.Notify();
    AwaitSizes(usage, [](const auto& sizes) { return sizes.mission_bytes.contains("hall"); });
  }
}

}  // namespace store_usage_test
}  // namespace plumescout::server
