// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/types/error_reason.h"
#include "formats/file_io.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace database_test {

using ::testing::HasSubstr;
using Access = Database::Access;

class DatabaseTest : public ::testing::Test {
 protected:
  std::unique_ptr<Database> Make() {
    auto database = Database::Open(path_, Access::kMake).value();
    EXPECT_TRUE(database->Execute("CREATE TABLE t(id INTEGER PRIMARY KEY, bytes BLOB)").ok());
    return database;
  }

  const TempFolder folder_;
  const std::string path_ = folder_.File("db");
  FaultyDisk disk_;
};

TEST_F(DatabaseTest, BytesSurvive) {
  const auto database = Make();
  const std::string bytes("a\0b", 3);
  for (const std::string& written : {bytes, std::string()}) {
    ASSERT_TRUE(database->Use("INSERT INTO t(bytes) VALUES(?)").BindBlob(written).Run().ok());
    Query query = database->Use("SELECT bytes, id FROM t WHERE id = ?");
    ASSERT_TRUE(*query.Bind(database->last_insert_id()).Next());
    EXPECT_EQ(query.Bytes(0), written);
    EXPECT_EQ(query.Int(1), database->last_insert_id());
    EXPECT_FALSE(*query.Next());
  }
  EXPECT_EQ(database->changes(), 1);
  EXPECT_EQ(*database->GetInt("SELECT count(*) FROM t"), 2);
  EXPECT_EQ(*database->GetText("SELECT typeof(bytes) FROM t WHERE id = 2"), "blob");
  EXPECT_TRUE(absl::IsDataLoss(database->GetInt("SELECT id FROM t WHERE id = 9").status()));
}

TEST_F(DatabaseTest, ATransactionThatIsNotCommittedChangesNothing) {
  const auto database = Make();
  for (const bool commits : {false, true}) {
    Transaction transaction(database.get());
    ASSERT_TRUE(transaction.Begin().ok());
    ASSERT_TRUE(database->Execute("INSERT INTO t(bytes) VALUES(x'00')").ok());
    if (commits) {
      ASSERT_TRUE(transaction.Commit().ok());
    }
  }
  EXPECT_EQ(*database->GetInt("SELECT count(*) FROM t"), 1);
}

TEST_F(DatabaseTest, AReaderSeesOneStateAndWritesNothing) {
  Make();
  const auto writer = Database::Open(path_, Access::kWrite).value();
  const auto reader = Database::Open(path_, Access::kRead).value();
  Transaction transaction(reader.get());
  ASSERT_TRUE(transaction.BeginToRead().ok());
  EXPECT_EQ(*reader->GetInt("SELECT count(*) FROM t"), 0);
  ASSERT_TRUE(writer->Execute("INSERT INTO t(bytes) VALUES(x'00')").ok());
  EXPECT_GT(writer->logged_pages(), 0);
  EXPECT_EQ(*reader->GetInt("SELECT count(*) FROM t"), 0);
  EXPECT_FALSE(reader->Execute("INSERT INTO t(bytes) VALUES(x'00')").ok());
}

TEST_F(DatabaseTest, ACheckpointEmptiesTheLog) {
  Make();
  const auto database = Database::Open(path_, Access::kWrite).value();
  ASSERT_TRUE(database->Execute("INSERT INTO t(bytes) VALUES(x'00')").ok());
  EXPECT_FALSE(ReadFile(path_ + "-wal", 1 << 20)->empty());
  EXPECT_TRUE(database->Checkpoint(/*whole=*/true).ok());
  EXPECT_TRUE(ReadFile(path_ + "-wal", 1 << 20)->empty());
  EXPECT_EQ(database->logged_pages(), 0);
  EXPECT_TRUE(database->Checkpoint(/*whole=*/false).ok());
}

TEST_F(DatabaseTest, ErrorsOfTheDiskNameTheFileAndMayPass) {
  Make();
  for (const DiskFault fault : {DiskFault::kFull, DiskFault::kIoError}) {
    const auto database = Database::Open(path_, Access::kWrite).value();
    disk_.FailAfter(0, fault, /*for_ever=*/true);
    const absl::Status status = database->Execute("INSERT INTO t(bytes) VALUES(x'00')");
    EXPECT_EQ(ErrorReason(status), reason::kStoreUnavailable) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(path_));
    EXPECT_EQ(database->was_full(), fault == DiskFault::kFull);
    disk_.Heal();
  }
  const absl::Status missing = Database::Open(folder_.File("no"), Access::kWrite).status();
  EXPECT_EQ(ErrorReason(missing), reason::kStoreUnavailable) << missing;
}

TEST_F(DatabaseTest, WhatIsNoDatabaseIsDamaged) {
  ASSERT_TRUE(WriteFile(path_, std::string(5000, 'x')).ok());
  const absl::Status status = Database::Open(path_, Access::kWrite).status();
  EXPECT_EQ(ErrorReason(status), reason::kStoreDamaged) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr(path_));
}

TEST_F(DatabaseTest, AStatementThatCannotBeIsAnErrorWhenItIsUsed) {
  const auto database = Make();
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(ErrorReason(database->Use("SELECT x FROM nothing WHERE y = ?").Bind(1).Run()),
              reason::kStoreDamaged);
  }
}

}  // namespace database_test
}  // namespace plumescout::server
