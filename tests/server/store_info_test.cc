// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/server/held_store.h"

namespace plumescout::server {
namespace store_info_test {

TEST(StoreInfoTest, WithoutAStoreNothingIsAvailable) {
  const v1::StoreInfo info = TellOfStore(StoreConfig(), nullptr, nullptr);
  EXPECT_EQ(info.engine(), "none");
  EXPECT_FALSE(info.available());
}

TEST(StoreInfoTest, TellsHowMuchIsKeptAndHowMuchWaits) {
  HeldStore store;
  ASSERT_TRUE(store.Create("hall", "header").ok());
  ASSERT_TRUE(store.Create("acme/yard", "longer header").ok());
  store.set_state(WithBacklog(42));
  const StoreUsage usage(&store, absl::Milliseconds(1));
  while (usage.sizes().mission_bytes.size() < 2) std::this_thread::yield();
  const v1::StoreInfo info = TellOfStore({.engine = kSqliteStore}, &store, &usage);
  EXPECT_EQ(info.engine(), "sqlite");
  EXPECT_TRUE(info.available());
  EXPECT_EQ(info.trouble(), "");
  EXPECT_EQ(info.backlog_bytes(), 42);
  const auto sizes = usage.sizes().mission_bytes;
  EXPECT_EQ(info.stored_bytes(), sizes.at("hall") + sizes.at("acme/yard"));
  EXPECT_EQ(info.node(), "") << "a server that is alone has no name";
}

TEST(StoreInfoTest, SaysWhatIsWrongWithIt) {
  HeldStore store;
  store.set_state(Refusing("the disk is full"));
  const StoreConfig config{.engine = kPostgresqlStore, .node = "one", .cluster = "yard"};
  const v1::StoreInfo info = TellOfStore(config, &store, nullptr, {.unreached = {"n2", "n3"}});
  EXPECT_THAT(info.unreached_nodes(), testing::ElementsAre("n2", "n3"));
  EXPECT_FALSE(info.available());
  EXPECT_EQ(info.trouble(), "the disk is full");
  EXPECT_EQ(info.node(), "one");
  EXPECT_EQ(info.cluster(), "yard");
}

}  // namespace store_info_test
}  // namespace plumescout::server
