// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/import_desk.h"

#include <gtest/gtest.h>

#include "tests/server/service_clients.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace import_desk_test {

TEST(ImportDeskTest, TakesSoManyAtATime) {
  MemoryStore store;
  MissionRegistry registry({}, {});
  ImportDesk desk(&store, &registry, {.max_at_once = 2});
  auto first = desk.Open();
  const auto second = desk.Open();
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_TRUE(absl::IsResourceExhausted(desk.Open().status()));
  first->reset();
  EXPECT_TRUE(desk.Open().ok());
}

TEST(ImportDeskTest, FolderWithoutRoomIsNamedAndTakesNoPlace) {
  MemoryStore store;
  MissionRegistry registry({}, {});
  ImportDesk desk(&store, &registry, {.max_at_once = 1, .folder = "/no/such/folder"});
  EXPECT_TRUE(absl::IsUnavailable(desk.Open().status()));
  EXPECT_TRUE(absl::IsUnavailable(desk.Open().status()));
}

}  // namespace import_desk_test
}  // namespace plumescout::server
