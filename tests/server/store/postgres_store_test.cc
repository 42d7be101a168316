// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/types/error_reason.h"
#include "tests/server/store/shared_work.h"
#include "tests/server/store/store_work.h"

namespace plumescout::server {
namespace postgres_store_test {

using ::testing::HasSubstr;

TEST(PostgresStoreTest, WhatIsDurableOutlivesTheServerAndTheDatabase) {
  const std::string url = PostgresServer::Shared().NewUrl();
  {
    const auto store = OpenShared(url);
    EXPECT_TRUE(store->is_durable());
    ASSERT_EQ(*store->Create("house", "header"), 1);
    ASSERT_TRUE(AppendNow(*store, "house", 1, 1, Records("house", 1, 100)).ok());
    EXPECT_GT(store->disk_bytes(), 4000);
  }
  PostgresServer::Shared().Kill();
  PostgresServer::Shared().Start();
  const auto store = OpenShared(url);
  EXPECT_EQ(store->Acquire("house")->epoch, 2);
  EXPECT_EQ(*ReadAll(*store, "house"), Numbered("house", 1, 100));
}

TEST(PostgresStoreTest, WhileTheDatabaseIsAwayAppendsWaitAndReadersHearSo) {
  const std::string url = PostgresServer::Shared().NewUrl();
  const auto store = OpenShared(url);
  ASSERT_EQ(*store->Create("house", ""), 1);
  PostgresServer::Shared().Kill();
  Told told;
  store->Append("house", 1, 1, {"a"}, told.done());
  EXPECT_TRUE(Eventually([&] { return !store->state().status.ok(); }));
  EXPECT_EQ(ErrorReason(store->state().status), reason::kStoreUnavailable);
  EXPECT_EQ(store->state().backlog_records, 1);
  for (const absl::Status& status :
       {store->List().status(), store->Peek("house").status(), store->Read("house", 1).status(),
        store->Create("mill", "").status(), store->Acquire("house").status()}) {
    EXPECT_EQ(ErrorReason(status), reason::kStoreUnavailable) << status;
  }
  EXPECT_EQ(store->disk_bytes(), 0);
  EXPECT_FALSE(told.is_told());
  PostgresServer::Shared().Start();
  EXPECT_TRUE(told.Wait().ok());
  EXPECT_EQ(ReadAll(*store, "house")->size(), 1U);
}

TEST(PostgresStoreTest, ADatabaseThatTurnsReadOnlyTakesNothingAndTheNodeLosesItsLease) {
  const std::string url = PostgresServer::Shared().NewUrl();
  PostgresStoreOptions options = SharedOptions(url);
  options.lease = absl::Seconds(1);
  const auto store = PostgresStore::Open(options).value();
  ASSERT_EQ(*store->Create("house", ""), 1);
  const auto set_read_only = [&](const std::string& value) {
    PostgresServer::Shared().Ask("", "ALTER SYSTEM SET default_transaction_read_only = " + value);
    PostgresServer::Shared().Ask("", "SELECT pg_reload_conf()");
  };
  set_read_only("on");
  // Sessions hear of it one by one.
  std::vector<std::unique_ptr<Told>> told;
  EXPECT_TRUE(Eventually([&] {
    told.push_back(std::make_unique<Told>());
    const auto number = static_cast<std::int64_t>(told.size());
    store->Append("house", 1, number, {"a"}, told.back()->done());
    return !store->state().status.ok();
  }));
  EXPECT_THAT(std::string(store->state().status.message()), HasSubstr("read-only"));
  EXPECT_TRUE(Eventually([&] { return !store->nodes()->status().ok(); }));
  set_read_only("off");
  for (const auto& answer : told) EXPECT_TRUE(answer->Wait().ok());
  EXPECT_TRUE(Eventually([&] { return store->nodes()->status().ok(); }));
}

TEST(PostgresStoreTest, WhatIsAwayOrUnreadableIsRefusedByName) {
  PostgresStoreOptions options = SharedOptions("postgresql://robot:secret@127.0.0.1:1/plumes");
  const absl::Status away = PostgresStore::Open(options).status();
  EXPECT_EQ(ErrorReason(away), reason::kStoreUnavailable) << away;
  EXPECT_THAT(std::string(away.message()), HasSubstr("127.0.0.1:1/plumes"));
}

}  // namespace postgres_store_test
}  // namespace plumescout::server
