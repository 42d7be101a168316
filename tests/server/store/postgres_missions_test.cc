// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/postgres_missions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/types/error_reason.h"
#include "tests/server/store/shared_house.h"

namespace plumescout::server {
namespace postgres_missions_test {

using ::testing::HasSubstr;

using PostgresMissionsTest = SharedHouse;

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

TEST_F(PostgresMissionsTest, ADamagedSnapshotIsLeftOut) {
  EXPECT_EQ(LoadSharedMission(*connection_, "house")->known.snapshots.size(), 1U);
  Damage("UPDATE plumescout_snapshot SET digest = 8");
  const auto mission = LoadSharedMission(*connection_, "house");
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_TRUE(mission->known.snapshots.empty());
}

}  // namespace postgres_missions_test
}  // namespace plumescout::server
