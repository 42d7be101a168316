// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/memory_store.h"

#include <gtest/gtest.h>

#include "tests/server/store/store_work.h"

namespace plumescout::server {
namespace memory_store_test {

TEST(MemoryStore, IsDurableOnlyIfItIsToldToSaySo) {
  EXPECT_FALSE(MemoryStore().is_durable());
  EXPECT_TRUE(MemoryStore(true).is_durable());
}

TEST(MemoryStore, ReadersOutliveMissionAndStore) {
  std::unique_ptr<JournalReader> reader;
  {
    MemoryStore store;
    ASSERT_TRUE(store.Create("house", "").ok());
    ASSERT_TRUE(AppendNow(store, "house", 1, 1, {"a", "b"}).ok());
    reader = *store.Read("house", 1);
    ASSERT_TRUE(RemoveNow(store, "house", 1).ok());
  }
  EXPECT_EQ((**reader->Next()).bytes, "a");
  EXPECT_EQ((**reader->Next()).bytes, "b");
  EXPECT_FALSE(reader->Next()->has_value());
}

}  // namespace memory_store_test
}  // namespace plumescout::server
