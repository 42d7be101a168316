// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/open_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "server/store/store_nodes.h"
#include "tests/support/postgres_server.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace open_store_test {

TEST(OpenStoreTest, NoneIsNoStore) {
  const auto store = OpenStore({});
  ASSERT_TRUE(store.ok()) << store.status();
  EXPECT_EQ(*store, nullptr);
}

TEST(OpenStoreTest, SqliteIsInTheFolder) {
  const TempFolder folder;
  StoreConfig config;
  config.engine = kSqliteStore;
  config.folder = folder.File("missions");
  {
    const auto store = OpenStore(config);
    ASSERT_TRUE(store.ok()) << store.status();
    EXPECT_TRUE((*store)->is_durable());
    ASSERT_TRUE((*store)->Create("hall", "header").ok());
    const absl::Status second = OpenStore(config).status();
    EXPECT_TRUE(absl::IsFailedPrecondition(second)) << second;
    EXPECT_THAT(std::string(second.message()), testing::HasSubstr(config.folder));
  }
  const auto again = OpenStore(config);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ((*again)->List()->size(), 1U);
}

TEST(OpenStoreTest, ADatabaseNeedsAServerThatIsBuiltForIt) {
  StoreConfig config;
  config.engine = kPostgresqlStore;
  config.url = HasPostgresql() ? PostgresServer::Shared().NewUrl() : "postgresql://db/plumes";
  config.node = "n1";
  const auto store = OpenStore(config, "10.0.0.1:50551");
  if (HasPostgresql()) {
    ASSERT_TRUE(store.ok()) << store.status();
    EXPECT_EQ((*store)->nodes()->self(), (StoreNode{"n1", "10.0.0.1:50551"}));
    return;
  }
  EXPECT_TRUE(absl::IsInvalidArgument(store.status())) << store.status();
  EXPECT_THAT(std::string(store.status().message()),
              testing::HasSubstr("PostgreSQL is not built in"));
}

TEST(OpenStoreTest, AFolderThatCannotBeMadeIsAnErrorThatNamesIt) {
  StoreConfig config;
  config.engine = kSqliteStore;
  config.folder = "/proc/no/such/folder";
  const absl::Status refused = OpenStore(config).status();
  EXPECT_FALSE(refused.ok());
  EXPECT_THAT(std::string(refused.message()), testing::HasSubstr("/proc/no"));
}

}  // namespace open_store_test
}  // namespace plumescout::server
