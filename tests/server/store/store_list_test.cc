// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/store_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/file_io.h"
#include "tests/server/store/store_work.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace store_list_test {

TEST(StoreListTest, MissionsAreListedAndNothingChanges) {
  const TempFolder folder;
  {
    const auto store = SqliteStore::Open(InFolder(folder.path())).value();
    ASSERT_TRUE(store->Create("house", "header").ok());
    ASSERT_TRUE(AppendNow(*store, "house", 1, 1, Records("house", 1, 3)).ok());
    ASSERT_TRUE(store->Create("acme/mill", "header").ok());
  }
  const std::string before = *ReadFile(folder.File("store.db"), 1 << 24);
  const auto missions = ListStore(folder.path());
  ASSERT_TRUE(missions.ok()) << missions.status();
  ASSERT_EQ(missions->size(), 2u);
  EXPECT_EQ((*missions)[0].key, "acme/mill");
  EXPECT_EQ((*missions)[1].key, "house");
  EXPECT_EQ((*missions)[1].head, 3);
  EXPECT_GT((*missions)[1].bytes, 0);
  EXPECT_TRUE(*ReadFile(folder.File("store.db"), 1 << 24) == before);
}

TEST(StoreListTest, FolderWithoutAStoreAndOneInUseAreRefused) {
  const TempFolder folder;
  EXPECT_TRUE(absl::IsNotFound(ListStore(folder.path()).status()));
  const auto store = SqliteStore::Open(InFolder(folder.path())).value();
  EXPECT_TRUE(absl::IsFailedPrecondition(ListStore(folder.path()).status()));
}

}  // namespace store_list_test
}  // namespace plumescout::server
