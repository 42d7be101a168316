// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_usage.h"

#include <gtest/gtest.h>

#include "tests/server/held_store.h"

namespace plumescout::server {
namespace store_usage_test {

TEST(StoreUsageTest, LooksOnceAMinute) {
  HeldStore store;
  ASSERT_TRUE(store.Create("hall", "header").ok());
  SteadyTime now;
  StoreUsage usage(&store, [&] { return now; });
  EXPECT_EQ(usage.BytesByMission().count("hall"), 1U);
  ASSERT_TRUE(store.Create("acme/yard", "header").ok());
  now += std::chrono::seconds(59);
  EXPECT_EQ(usage.BytesByMission().size(), 1U);
  now += std::chrono::seconds(1);
  const auto bytes = usage.BytesByMission();
  ASSERT_EQ(bytes.size(), 2U);
  EXPECT_GT(bytes.at("acme/yard"), 0);
}

}  // namespace store_usage_test
}  // namespace plumescout::server
