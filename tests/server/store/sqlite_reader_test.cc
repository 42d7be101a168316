// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/sqlite_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/types/error_reason.h"
#include "server/store/database.h"
#include "tests/server/store/store_work.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace sqlite_reader_test {

using ::testing::HasSubstr;

class SqliteReaderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(store_->Create("house", "header").ok());
    ASSERT_TRUE(AppendNow(*store_, "house", 1, 1, Records("house", 1, kCount)).ok());
  }

  void Change(const std::string& sql) {
    const auto database = Database::Open(file_, Database::Access::kWrite).value();
    ASSERT_TRUE(database->Execute(sql).ok());
  }

  static constexpr int kCount = 600;

  const TempFolder folder_;
  const std::string file_ = folder_.File("store.db");
  FaultyDisk disk_;
  const std::unique_ptr<SqliteStore> store_ = SqliteStore::Open(InFolder(folder_.path())).value();
};

TEST_F(SqliteReaderTest, ReadsToWhereTheMissionEnded) {
  const auto reader = SqliteReader::Open(file_, "house", kCount).value();
  EXPECT_EQ(reader->row().head, kCount);
  EXPECT_EQ((*reader->Next())->bytes, RecordBytes("house", kCount));
  EXPECT_FALSE(reader->Next()->has_value());
  EXPECT_TRUE(absl::IsNotFound(SqliteReader::Open(file_, "mill", 1).status()));
}

TEST_F(SqliteReaderTest, EveryDamageIsNamedByItsRecord) {
  struct Case {
    const char* change;
    const char* record;
  };
  for (const Case& damage :
       {Case{"UPDATE record SET bytes = x'00' WHERE number = 300", "record 300 "},
        Case{"UPDATE record SET crc = crc + 1 WHERE number = 300", "record 300 "},
        Case{"DELETE FROM record WHERE number = 300", "record 300 "},
        Case{"UPDATE record SET bytes = (SELECT bytes FROM record WHERE number = 301) "
             "WHERE number = 300",
             "record 300 "},
        Case{"DELETE FROM record WHERE number = 600", "record 600 "}}) {
    Change("CREATE TABLE saved AS SELECT * FROM record");
    Change(damage.change);
    const absl::Status status = ReadAll(*store_, "house").status();
    EXPECT_EQ(ErrorReason(status), reason::kStoreDamaged) << damage.change << ": " << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(damage.record)) << damage.change;
    EXPECT_THAT(std::string(status.message()), HasSubstr(file_));
    Change("DELETE FROM record");
    Change("INSERT INTO record SELECT * FROM saved; DROP TABLE saved");
    ASSERT_TRUE(ReadAll(*store_, "house").ok());
  }
}

TEST_F(SqliteReaderTest, AMissionThatIsRemovedMeanwhileIsNotFound) {
  const auto reader = SqliteReader::Open(file_, "house", 1).value();
  ASSERT_TRUE(reader->Next().ok());
  ASSERT_TRUE(RemoveNow(*store_, "house", 1).ok());
  ASSERT_TRUE(store_->Create("house", "another").ok());
  ASSERT_TRUE(AppendNow(*store_, "house", 1, 1, Records("house", 1, kCount)).ok());
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(PutStandingNow(*store_, "house", 1, "").ok());  // chores
  absl::Status status;
  for (int i = 1; i < kCount && status.ok(); ++i) status = reader->Next().status();
  EXPECT_TRUE(absl::IsNotFound(status)) << status;
}

TEST_F(SqliteReaderTest, ADiskThatGivesNothingIsUnavailable) {
  EXPECT_EQ(ErrorReason(SqliteReader::Open(folder_.File("none"), "house", 1).status()),
            reason::kStoreUnavailable);
}

}  // namespace sqlite_reader_test
}  // namespace plumescout::server
