// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_changes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "server/store/store_errors.h"
#include "tests/server/store/shared_house.h"

namespace plumescout::server {
namespace postgres_changes_test {

using PostgresChangesTest = SharedHouse;

TEST_F(PostgresChangesTest, WhatIsDamagedIsDiscardedWhole) {
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

TEST_F(PostgresChangesTest, NothingIsWrittenToARowThatHasChanged) {
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

TEST_F(PostgresChangesTest, OnlyWhoHoldsALeaseBecomesAnOwner) {
  const SharedRow before = Row();
  MissionRow after = before.row;
  ++after.writes;
  ++after.epoch;
  EXPECT_EQ(Done(AcquireStatement(before.row, after, before.owner + 1)), 0);
  ExpireLease(url_, "n1");
  EXPECT_EQ(Done(AcquireStatement(before.row, after, before.owner)), 0);
  EXPECT_EQ(Row().row.epoch, 1);
}

}  // namespace postgres_changes_test
}  // namespace plumescout::server
