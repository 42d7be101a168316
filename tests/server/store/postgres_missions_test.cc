// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_missions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "core/types/error_reason.h"
#include "server/store/store_errors.h"
#include "tests/server/store/shared_work.h"
#include "tests/server/store/store_work.h"

namespace plumescout::server {
namespace postgres_missions_test {

using ::testing::HasSubstr;

class PostgresMissionsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(*store_->Create("house", "header"), 1);
    ASSERT_TRUE(AppendNow(*store_, "house", 1, 1, {"a", "b"}).ok());
    ASSERT_TRUE(PutStandingNow(*store_, "house", 1, "paused").ok());
    ASSERT_TRUE(PutSnapshotNow(*store_, "house", 1, {2, 7, "state"}).ok());
  }
  void Damage(const std::string& sql) { PostgresServer::Shared().Ask(url_, sql); }
  SharedRow Row() {
    const std::string keys[] = {"house"};
    return *LoadSharedRows(*connection_, keys)->at("house");
  }
  std::int64_t Done(const PostgresStatement& statement) {
    return connection_->Run(statement, absl::Seconds(30))->Int(0, 0);
  }

  const std::string url_ = PostgresServer::Shared().NewUrl();
  const std::unique_ptr<PostgresStore> store_ = OpenShared(url_);
  const std::unique_ptr<PostgresConnection> connection_ =
      PostgresConnection::Open(url_, absl::Seconds(30)).value();
};

TEST_F(PostgresMissionsTest, ARowIsLoadedWithItsOwner) {
  const SharedRow shared = Row();
  EXPECT_EQ(shared.row.head, 2);
  EXPECT_EQ(shared.row.epoch, 1);
  EXPECT_EQ(shared.living_node, "n1");
  EXPECT_EQ(shared.standing_bytes, 6);
  ExpireLease(url_, "n1");
  EXPECT_EQ(Row().living_node, "");
  EXPECT_EQ(Row().owner, shared.owner);
}

TEST_F(PostgresMissionsTest, WhatIsDamagedIsNamed) {
  const struct {
    const char* sql;
    const char* named;
  } cases[] = {
      {"UPDATE plumescout_record SET crc = crc + 1 WHERE number = 2", "record 2"},
      {"DELETE FROM plumescout_record WHERE number = 2", "record 2"},
      {"UPDATE plumescout_standing SET bytes = 'finished'", "the standing"},
      {"UPDATE plumescout_mission SET header = 'other'", "the header"},
      {"UPDATE plumescout_progress SET head = 1", "the progress"},
      {"DELETE FROM plumescout_progress", "the progress"},
  };
  for (const auto& c : cases) {
    Damage(c.sql);
    const absl::Status found = LoadSharedMission(*connection_, "house").status();
    EXPECT_EQ(ErrorReason(found), reason::kStoreDamaged) << c.sql << ": " << found;
    EXPECT_THAT(std::string(found.message()), HasSubstr(c.named));
  }
}

TEST_F(PostgresMissionsTest, WhatIsDamagedIsDiscardedWhole) {
  const auto other = OpenShared(url_, "n2");
  for (const char* sql : {"UPDATE plumescout_record SET crc = crc + 1",
                          "UPDATE plumescout_standing SET bytes = 'finished'",
                          "UPDATE plumescout_mission SET header = 'other' WHERE key = 'house'",
                          "UPDATE plumescout_progress SET head = head + 1 WHERE head > 0",
                          "DELETE FROM plumescout_progress WHERE head > 0"}) {
    ASSERT_TRUE(other->Create("mill", "header").ok());
    Damage(sql);
    if (absl::StartsWith(sql, "UPDATE")) {
      EXPECT_EQ(NodeElsewhere(DiscardNow(*other, "house")), "n1") << "it lives";
    }
    EXPECT_TRUE(DiscardNow(*store_, "house").ok()) << sql;
    EXPECT_TRUE(absl::IsNotFound(store_->Peek("house").status()));
    EXPECT_TRUE(absl::IsNotFound(DiscardNow(*store_, "house")));
    EXPECT_EQ(store_->Peek("mill")->header, "header") << "others are whole";
    ASSERT_TRUE(RemoveNow(*other, "mill", 1).ok());
    SetUp();  // the name is free
  }
  Damage("UPDATE plumescout_mission SET header = 'other'");
  ExpireLease(url_, "n1");
  EXPECT_TRUE(DiscardNow(*other, "house").ok()) << "it was nobody's";
}

TEST_F(PostgresMissionsTest, ADamagedSnapshotIsLeftOut) {
  EXPECT_EQ(LoadSharedMission(*connection_, "house")->known.snapshots.size(), 1U);
  Damage("UPDATE plumescout_snapshot SET digest = 8");
  const auto mission = LoadSharedMission(*connection_, "house");
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_TRUE(mission->known.snapshots.empty());
}

TEST_F(PostgresMissionsTest, NothingIsWrittenToARowThatHasChanged) {
  const SharedRow before = Row();
  MissionRow after = before.row;
  ++after.writes;
  EXPECT_EQ(Done(SaveStatement(before.row, after)), 1);
  const std::vector<std::string> records = {"c"};
  EXPECT_EQ(Done(SaveStatement(before.row, after)), 0);
  EXPECT_EQ(Done(AppendStatement(before.row, after, records)), 0);
  EXPECT_EQ(Done(StandingStatement(before.row, after, "x")), 0);
  EXPECT_EQ(Done(SnapshotStatement(before.row, after, {1, 1, "x"}, {})), 0);
  EXPECT_EQ(Done(AcquireStatement(before.row, after, before.owner)), 0);
  EXPECT_EQ(Done(RemoveStatement(before.row)), 0);
  const auto mission = LoadSharedMission(*connection_, "house");
  EXPECT_EQ(mission->known.standing, "paused");
  EXPECT_EQ(mission->known.snapshots.size(), 1U);
  EXPECT_EQ(*ReadAll(*store_, "house"), (std::vector<JournalRecord>{{1, "a"}, {2, "b"}}));
}

TEST_F(PostgresMissionsTest, OnlyWhoHoldsALeaseBecomesAnOwner) {
  const SharedRow before = Row();
  MissionRow after = before.row;
  ++after.writes;
  ++after.epoch;
  EXPECT_EQ(Done(AcquireStatement(before.row, after, before.owner + 1)), 0);
  ExpireLease(url_, "n1");
  EXPECT_EQ(Done(AcquireStatement(before.row, after, before.owner)), 0);
  EXPECT_EQ(Row().row.epoch, 1);
}

}  // namespace postgres_missions_test
}  // namespace plumescout::server
