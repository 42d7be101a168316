// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "core/types/error_reason.h"
#include "server/store/store_errors.h"
#include "tests/server/store/shared_work.h"
#include "tests/server/store/store_work.h"

namespace plumescout::server {
namespace postgres_nodes_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class PostgresNodesTest : public ::testing::Test {
 protected:
  std::string Ask(const std::string& sql) { return PostgresServer::Shared().Ask(url_, sql); }

  const std::string url_ = PostgresServer::Shared().NewUrl();
};

TEST_F(PostgresNodesTest, AMissionIsOfTheNodeThatMadeItUntilItLeaves) {
  auto first = OpenShared(url_, "n1");
  const auto second = OpenShared(url_, "n2");
  ASSERT_EQ(*first->Create("house", ""), 1);
  EXPECT_THAT(*second->nodes()->ListLiving(),
              ElementsAre(StoreNode{"n1", "n1.example:1"}, StoreNode{"n2", "n2.example:1"}));
  EXPECT_EQ(*second->nodes()->FindOwner("house"), "n1");
  EXPECT_TRUE(absl::IsNotFound(second->nodes()->FindOwner("mill").status()));

  const absl::Status elsewhere = second->Acquire("house").status();
  EXPECT_EQ(ErrorReason(elsewhere), reason::kMissionElsewhere);
  EXPECT_EQ(NodeElsewhere(elsewhere), "n1");

  first = nullptr;
  EXPECT_EQ(*second->nodes()->FindOwner("house"), std::nullopt);
  EXPECT_EQ(second->Acquire("house")->epoch, 2);
  EXPECT_EQ(*second->nodes()->FindOwner("house"), "n2");
}

TEST_F(PostgresNodesTest, WhatIsReleasedIsTheNextOnes) {
  const auto first = OpenShared(url_, "n1");
  const auto second = OpenShared(url_, "n2");
  ASSERT_EQ(*first->Create("house", ""), 1);
  EXPECT_EQ(ErrorReason(first->nodes()->Release("house", 2)), reason::kFenced);
  EXPECT_EQ(*second->nodes()->FindOwner("house"), "n1");
  EXPECT_TRUE(absl::IsNotFound(first->nodes()->Release("mill", 1)));

  EXPECT_TRUE(first->nodes()->Release("house", 1).ok());
  EXPECT_EQ(*second->nodes()->FindOwner("house"), std::nullopt);
  EXPECT_EQ(second->Acquire("house")->epoch, 2);
  EXPECT_EQ(ErrorReason(first->nodes()->Release("house", 1)), reason::kFenced);
  EXPECT_EQ(ErrorReason(AppendNow(*first, "house", 1, 1, {"late"})), reason::kFenced);
}

TEST_F(PostgresNodesTest, MissionsOfTheWholeStoreAreListedWithTheirNodes) {
  const auto first = OpenShared(url_, "n1");
  const auto second = OpenShared(url_, "n2");
  const std::string odd = std::string("acme/\0odd", 9);
  for (const std::string& key : {std::string("hall"), std::string("acme/hall"), odd}) {
    ASSERT_TRUE(first->Create(key, "").ok());
  }
  ASSERT_TRUE(second->Create("acme0", "").ok());
  ASSERT_TRUE(first->nodes()->Release("hall", 1).ok());
  const OwnedMission of_first{"acme/hall", "n1"};
  const auto list = [&](OwnedMissionQuery query) {
    query.limit = query.limit == 0 ? 9 : query.limit;
    return second->nodes()->ListMissions(query).value();
  };
  EXPECT_THAT(list({}), ElementsAre(OwnedMission{odd, "n1"}, of_first, OwnedMission{"acme0", "n2"},
                                    OwnedMission{"hall", ""}));
  EXPECT_THAT(list({.after = odd, .limit = 1}), ElementsAre(of_first));
  EXPECT_THAT(list({.begins_with = "acme/"}), ElementsAre(OwnedMission{odd, "n1"}, of_first));
  EXPECT_THAT(list({.after = "acme/hall", .begins_with = "acme/"}), ElementsAre());
  EXPECT_THAT(list({.last_part = "hall"}), ElementsAre(of_first, OwnedMission{"hall", ""}));
  EXPECT_THAT(list({.last_part = "all"}), ElementsAre());
  ExpireLease(url_, "n1");
  EXPECT_THAT(list({.last_part = "hall", .limit = 1}), ElementsAre(OwnedMission{"acme/hall", ""}));
}

TEST_F(PostgresNodesTest, WhatIsDamagedIsListedSoUntilSomebodyHasIt) {
  const auto first = OpenShared(url_, "n1");
  const auto second = OpenShared(url_, "n2");
  for (const char* key : {"hall", "mill"}) ASSERT_TRUE(first->Create(key, "").ok());
  for (const char* what : {"a record", "the header"}) {
    ASSERT_TRUE(second->nodes()->NoteDamage("hall", what).ok());
  }
  ASSERT_TRUE(second->nodes()->NoteDamage("attic", "it is not there").ok());
  EXPECT_THAT(*second->nodes()->ListMissions({.limit = 9}),
              ElementsAre(OwnedMission{"hall", "n1", "the header"}, OwnedMission{"mill", "n1"}));
  EXPECT_THAT(*second->List(),
              ElementsAre(StoredMission{"hall", 1, 0, 0, true}, StoredMission{"mill", 1, 0, 0}));
  ASSERT_EQ(first->Acquire("hall")->epoch, 2);
  EXPECT_FALSE(second->List()->front().is_damaged);
  Ask("UPDATE plumescout_progress SET epoch = 1");
  EXPECT_TRUE(second->List()->front().is_damaged) << "that is seen at once";
}

TEST_F(PostgresNodesTest, AMissionOfNobodyIsForgottenWhenItsTimeIsOver) {
  const auto first = OpenShared(url_, "n1");
  const auto second = OpenShared(url_, "n2");
  StoreNodes& nodes = *first->nodes();
  const absl::Duration over = -absl::Seconds(1);
  for (const char* key : {"hall", "mill", "yard"}) ASSERT_TRUE(first->Create(key, "").ok());
  ASSERT_TRUE(second->Create("attic", "").ok());
  ASSERT_TRUE(nodes.KeepFor({{"hall", over}, {"mill", absl::Hours(1)}, {"attic", over}}).ok());
  EXPECT_THAT(*nodes.ListForgotten(9), ElementsAre()) << "its node lives";
  for (const char* key : {"hall", "mill", "yard"}) ASSERT_TRUE(nodes.Release(key, 1).ok());
  ASSERT_TRUE(second->nodes()->Release("attic", 1).ok());
  EXPECT_THAT(*second->nodes()->ListForgotten(9), ElementsAre(ForgottenMission{"hall", 1}))
      << "a node speaks for its own only";

  ASSERT_EQ(second->Acquire("hall")->epoch, 2);
  ASSERT_TRUE(second->nodes()->Release("hall", 2).ok());
  EXPECT_THAT(*nodes.ListForgotten(9), ElementsAre()) << "somebody has called for it";

  ASSERT_EQ(second->Acquire("hall")->epoch, 3);
  ASSERT_EQ(second->Acquire("mill")->epoch, 2);
  ASSERT_TRUE(second->nodes()->KeepFor({{"hall", over}, {"mill", 2 * over}}).ok());
  ExpireLease(url_, "n2");
  EXPECT_THAT(*nodes.ListForgotten(9),
              ElementsAre(ForgottenMission{"mill", 2}, ForgottenMission{"hall", 3}));
  EXPECT_THAT(*nodes.ListForgotten(1), ElementsAre(ForgottenMission{"mill", 2}));
}

TEST_F(PostgresNodesTest, WhatIsKeptForGoodOrRemovedIsNotForgotten) {
  const auto store = OpenShared(url_, "n1");
  for (const char* key : {"hall", "mill"}) ASSERT_TRUE(store->Create(key, "").ok());
  StoreNodes& nodes = *store->nodes();
  const absl::Duration over = -absl::Seconds(1);
  ASSERT_TRUE(nodes.KeepFor({{"hall", over}, {"mill", over}}).ok());
  ASSERT_TRUE(nodes.KeepFor({{"hall", absl::InfiniteDuration()}}).ok());
  EXPECT_EQ(Ask("SELECT count(*) FROM plumescout_idle"), "1");
  EXPECT_TRUE(RemoveNow(*store, "mill", 1).ok());
  EXPECT_EQ(Ask("SELECT count(*) FROM plumescout_idle"), "0");
}

TEST_F(PostgresNodesTest, ALeaseThatRanOutLosesTheMissions) {
  PostgresStoreOptions options = SharedOptions(url_, "n1");
  options.lease = absl::Seconds(2);
  const auto first = PostgresStore::Open(options).value();
  const auto second = OpenShared(url_, "n2");
  ASSERT_EQ(*first->Create("house", ""), 1);
  std::atomic<int> losses = 0;
  first->nodes()->SetOnLost([&](const absl::Status& why) {
    EXPECT_FALSE(why.ok());
    EXPECT_LT(first->nodes()->lease_until(), SteadyNow());
    EXPECT_EQ(ErrorReason(first->nodes()->status()), reason::kStoreUnavailable);
    ++losses;
  });
  ExpireLease(url_, "n1");
  ASSERT_EQ(second->Acquire("house")->epoch, 2);
  ASSERT_TRUE(Eventually([&] { return losses > 0; }));
  EXPECT_EQ(ErrorReason(AppendNow(*first, "house", 1, 1, {"late"})), reason::kFenced);
  // It joins again, and owns nothing.
  ASSERT_TRUE(Eventually([&] { return first->nodes()->status().ok(); }));
  EXPECT_EQ(NodeElsewhere(first->Acquire("house").status()), "n2");
  EXPECT_EQ(losses, 1);
  first->nodes()->SetOnLost(nullptr);
}

TEST_F(PostgresNodesTest, ALeaseIsRenewedAndEndsBeforeItsOwnTime) {
  PostgresStoreOptions options = SharedOptions(url_, "n1");
  options.lease = absl::Seconds(2);
  const auto store = PostgresStore::Open(options).value();
  const SteadyTime first = store->nodes()->lease_until();
  EXPECT_LT(first, After(SteadyNow(), options.lease));
  ASSERT_TRUE(Eventually([&] { return store->nodes()->lease_until() > first; }));
}

TEST_F(PostgresNodesTest, ANameIsOneNodes) {
  const auto first = OpenShared(url_, "n1");
  PostgresStoreOptions options = SharedOptions(url_, "n1");
  options.lease = absl::Seconds(1);  // the other has a minute, so nobody waits for it
  const absl::Status refused = PostgresStore::Open(options).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(refused)) << refused;
  EXPECT_THAT(std::string(refused.message()), HasSubstr("store.node = n1"));
  EXPECT_THAT(std::string(refused.message()), HasSubstr("n1.example:1"));
  EXPECT_TRUE(first->nodes()->status().ok());
}

TEST_F(PostgresNodesTest, ANameThatIsRenewedMeanwhileIsTaken) {
  PostgresStoreOptions options = SharedOptions(url_, "n1");
  options.lease = absl::Seconds(6);
  const auto first = PostgresStore::Open(options).value();
  const absl::Status refused = PostgresStore::Open(options).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(refused)) << refused;
}

TEST_F(PostgresNodesTest, WhoLosesItsNameToAnotherSaysSoUntilThatIsGone) {
  PostgresStoreOptions options = SharedOptions(url_, "n1");
  options.lease = absl::Seconds(1);
  const auto store = PostgresStore::Open(options).value();
  Ask("UPDATE plumescout_node SET id = nextval('plumescout_ids'), address = 'other:1', "
      "expires = clock_timestamp() + interval '1 hour'");
  ASSERT_TRUE(Eventually([&] {
    return store->nodes()->status().message().find("is another server that lives, at other:1") !=
           absl::string_view::npos;
  })) << store->nodes()->status();
  EXPECT_EQ(ErrorReason(store->nodes()->status()), reason::kStoreUnavailable);
  Ask("DELETE FROM plumescout_node");
  EXPECT_TRUE(Eventually([&] { return store->nodes()->status().ok(); }));
}

TEST_F(PostgresNodesTest, WhoeverWasKilledIsWaitedFor) {
  OpenShared(url_, "n0");  // makes the tables
  Ask("INSERT INTO plumescout_node VALUES(7, 'n1', 'gone.example:1', now() + interval '1 s')");
  const auto store = PostgresStore::Open(SharedOptions(url_, "n1"));
  ASSERT_TRUE(store.ok()) << store.status();
  EXPECT_EQ(Ask("SELECT count(*) FROM plumescout_node WHERE id = 7"), "0");
}

TEST_F(PostgresNodesTest, ADatabaseThatStaysAwayEndsTheLease) {
  PostgresStoreOptions options = SharedOptions(url_, "n1");
  options.lease = absl::Seconds(1);
  const auto store = PostgresStore::Open(options).value();
  std::atomic<bool> is_lost = false;
  store->nodes()->SetOnLost([&](const absl::Status&) { is_lost = true; });
  PostgresServer::Shared().Kill();
  EXPECT_TRUE(Eventually([&] { return is_lost.load(); }));
  EXPECT_EQ(ErrorReason(store->nodes()->status()), reason::kStoreUnavailable);
  EXPECT_EQ(ErrorReason(store->nodes()->Release("house", 1)), reason::kStoreUnavailable);
  PostgresServer::Shared().Start();
  EXPECT_TRUE(Eventually([&] { return store->nodes()->status().ok(); }));
  EXPECT_TRUE(Eventually([&] { return store->Create("house", "").ok(); }));
  store->nodes()->SetOnLost(nullptr);
}

}  // namespace postgres_nodes_test
}  // namespace plumescout::server
