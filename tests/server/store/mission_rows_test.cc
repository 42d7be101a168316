// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/mission_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/types/error_reason.h"
#include "server/store/schema.h"
#include "tests/server/store/store_work.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace mission_rows_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class MissionRowsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(MakeDatabase(path_).ok());
    database_ = Database::Open(path_, Database::Access::kWrite).value();
    rows_ = std::make_unique<MissionRows>(database_.get());
    row_ = rows_->Insert("house", "header").value();
    const std::vector<std::string> records = Records("house", 1, 10);
    ASSERT_TRUE(rows_->AddRecords(row_, records).ok());
    ASSERT_TRUE(rows_->PutStanding(row_, "paused").ok());
    ASSERT_TRUE(rows_->PutSnapshot(row_, {5, 55, "state"}).ok());
    ASSERT_TRUE(rows_->Save(row_).ok());
  }

  void Change(const std::string& sql) { ASSERT_TRUE(database_->Execute(sql).ok()); }

  const TempFolder folder_;
  const std::string path_ = folder_.File("store.db");
  FaultyDisk disk_;
  std::unique_ptr<Database> database_;
  std::unique_ptr<MissionRows> rows_;
  MissionRow row_;
};

TEST_F(MissionRowsTest, ARowIsFoundAsItWasSaved) {
  const auto found = *rows_->Find("house");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->id, row_.id);
  EXPECT_EQ(found->epoch, 1);
  EXPECT_EQ(found->head, 10);
  EXPECT_EQ(found->chain, row_.chain);
  EXPECT_EQ(found->bytes, row_.bytes);
  EXPECT_EQ(*rows_->Header(*found), "header");
  EXPECT_EQ(*rows_->Standing(*found), "paused");
  EXPECT_EQ(*rows_->ChainAt(*found, 10), row_.chain);
  EXPECT_THAT(*rows_->Snapshots(*found), SizeIs(1));
  EXPECT_FALSE(rows_->Find("hous")->has_value());
  EXPECT_THAT(*rows_->List(), SizeIs(1));
}

TEST_F(MissionRowsTest, EveryChangedColumnIsFoundOut) {
  for (const char* change :
       {"UPDATE progress SET epoch = epoch + 1", "UPDATE progress SET head = head - 1",
        "UPDATE progress SET chain = chain + 1", "UPDATE progress SET bytes = bytes + 1",
        "UPDATE progress SET standing_crc = 0", "UPDATE progress SET crc = crc + 1",
        "UPDATE progress SET writes = writes + 1", "DELETE FROM progress"}) {
    Transaction transaction(database_.get());
    ASSERT_TRUE(transaction.Begin().ok());
    Change(change);
    const absl::Status status = rows_->Find("house").status();
    EXPECT_EQ(ErrorReason(status), reason::kStoreDamaged) << change << ": " << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(path_));
    ASSERT_THAT(*rows_->List(), SizeIs(1));
    EXPECT_EQ(rows_->List()->front().epoch, 0) << change;
  }
  EXPECT_TRUE(rows_->Find("house").ok());
}

TEST_F(MissionRowsTest, DamagedHeadersAndStandingsAreFoundOut) {
  for (const char* change : {"UPDATE mission SET header = x'00'", "UPDATE mission SET crc = 5"}) {
    Transaction transaction(database_.get());
    ASSERT_TRUE(transaction.Begin().ok());
    Change(change);
    EXPECT_TRUE(absl::IsDataLoss(rows_->Header(row_).status())) << change;
  }
  for (const char* change : {"UPDATE standing SET bytes = x'00'", "DELETE FROM standing"}) {
    Transaction transaction(database_.get());
    ASSERT_TRUE(transaction.Begin().ok());
    Change(change);
    EXPECT_TRUE(absl::IsDataLoss(rows_->Standing(row_).status())) << change;
  }
}

TEST_F(MissionRowsTest, ADamagedSnapshotIsLeftOut) {
  for (const char* change : {"UPDATE snapshot SET bytes = x'00'", "UPDATE snapshot SET digest = 1",
                             "UPDATE snapshot SET revision = 6", "UPDATE snapshot SET crc = 1"}) {
    Transaction transaction(database_.get());
    ASSERT_TRUE(transaction.Begin().ok());
    Change(change);
    EXPECT_THAT(*rows_->Snapshots(row_), IsEmpty()) << change;
    EXPECT_EQ(*rows_->CountDamagedSnapshots(row_), 1) << change;
  }
  EXPECT_EQ(*rows_->CountDamagedSnapshots(row_), 0);
}

TEST_F(MissionRowsTest, HeldRecordsAreToldFromOthers) {
  EXPECT_TRUE(*rows_->HoldsRecords(row_, 1, Records("house", 1, 10)));
  EXPECT_TRUE(*rows_->HoldsRecords(row_, 4, Records("house", 4, 3)));
  EXPECT_FALSE(*rows_->HoldsRecords(row_, 4, Records("house", 5, 3)));
  EXPECT_FALSE(*rows_->HoldsRecords(row_, 9, Records("house", 9, 3)));
  EXPECT_FALSE(*rows_->HoldsRecords(row_, 0, Records("house", 0, 3)));
}

TEST_F(MissionRowsTest, RecordsOfRemovedMissionsGoInPieces) {
  MissionRow other = rows_->Insert("mill", "").value();
  ASSERT_TRUE(rows_->AddRecords(other, Records("mill", 1, 3)).ok());
  ASSERT_TRUE(rows_->Delete(row_).ok());
  EXPECT_FALSE(rows_->Find("house")->has_value());
  int pieces = 0;
  while (*rows_->PurgeRemoved(4)) ++pieces;
  EXPECT_EQ(pieces, 4);  // of 4, 4, 2 and 0 records
  EXPECT_EQ(*database_->GetInt("SELECT count(*) FROM record"), 3);
  ASSERT_TRUE(database_->Execute("INSERT INTO removed SELECT id FROM mission").ok());
  EXPECT_TRUE(absl::IsDataLoss(rows_->PurgeRemoved(4).status()));
  // Nobody who still reads the one that was removed meets another.
  EXPECT_GT(rows_->Insert("house", "").value().id, other.id);
}

TEST_F(MissionRowsTest, TrimmedRecordsGoInPieces) {
  MissionRow other = rows_->Insert("mill", "").value();
  ASSERT_TRUE(rows_->AddRecords(other, Records("mill", 1, 3)).ok());
  ASSERT_TRUE(rows_->Save(other).ok());
  const std::int64_t bytes = row_.bytes;
  for (const std::int64_t revision : {6, 8}) {
    ASSERT_TRUE(rows_->PutSnapshot(row_, {revision, 0, ""}).ok());
  }
  ASSERT_TRUE(rows_->Trim(row_).ok());
  ASSERT_TRUE(rows_->Trim(row_).ok()) << "again, to no effect";
  ASSERT_TRUE(rows_->Save(row_).ok());
  EXPECT_EQ(row_.base, 6);
  EXPECT_LT(row_.bytes, bytes);
  int pieces = 0;
  while (*rows_->PurgeTrimmed(4)) ++pieces;
  EXPECT_EQ(pieces, 2);  // of 4 and 2 records
  EXPECT_EQ(*database_->GetInt("SELECT count(*) FROM record"), 4 + 3);
  EXPECT_EQ(rows_->Find("house").value()->base, 6);
}

}  // namespace mission_rows_test
}  // namespace plumescout::server
