// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"
#include "formats/file_io.h"
#include "server/store/store_folder.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace schema_test {

using ::testing::HasSubstr;

class SchemaTest : public ::testing::Test {
 protected:
  // Changes it as another program would.
  void Execute(const std::string& sql) {
    const auto database = Database::Open(path_, Database::Access::kMake).value();
    ASSERT_TRUE(database->Execute(sql).ok());
  }
  std::string Bytes() const { return *ReadFile(path_, 1 << 20); }

  const TempFolder folder_;
  const std::string path_ = folder_.File("store.db");
  FaultyDisk disk_;
};

TEST_F(SchemaTest, ANewDatabaseIsOfThisFormat) {
  ASSERT_TRUE(MakeDatabase(path_).ok());
  EXPECT_TRUE(CheckDatabaseFile(path_).ok());
  EXPECT_FALSE(FileExists(path_ + ".new"));
  const auto database = Database::Open(path_, Database::Access::kWrite).value();
  EXPECT_TRUE(UpdateSchema(*database).ok());
  EXPECT_TRUE(CheckSchema(*database).ok());
  EXPECT_EQ(*database->GetInt("PRAGMA page_size"), 16384);
  EXPECT_EQ(*database->GetText("PRAGMA journal_mode"), "wal");
  EXPECT_EQ(*database->GetInt("PRAGMA synchronous"), 2);
}

TEST_F(SchemaTest, ADatabaseThatIsNotFinishedIsNotThere) {
  ASSERT_TRUE(MakeDatabase(path_).ok());
  const int steps = disk_.steps();
  ASSERT_GT(steps, 3);
  for (int step = 0; step < steps; ++step) {
    ASSERT_EQ(remove(path_.c_str()), 0);
    disk_.FailAfter(step, DiskFault::kIoError, /*for_ever=*/true);
    const absl::Status status = MakeDatabase(path_);
    disk_.Heal();
    EXPECT_EQ(ErrorReason(status), reason::kStoreUnavailable) << step << ": " << status;
    EXPECT_FALSE(FileExists(path_));
    EXPECT_TRUE(MakeDatabase(path_).ok());
    EXPECT_TRUE(CheckDatabaseFile(path_).ok());
  }
}

TEST_F(SchemaTest, TheDatabaseOfAnotherProgramIsNamedAndLeftAlone) {
  Execute("CREATE TABLE mission(id INTEGER)");
  const std::string before = Bytes();
  const absl::Status status = CheckDatabaseFile(path_);
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr(path_ + " is no store of PlumeScout"));
  EXPECT_EQ(Bytes(), before);

  ASSERT_TRUE(WriteFile(path_, "a text, and not a short one, but by no means a database").ok());
  EXPECT_TRUE(absl::IsFailedPrecondition(CheckDatabaseFile(path_)));
}

TEST_F(SchemaTest, ANewerFormatIsNamedAndLeftAlone) {
  ASSERT_TRUE(MakeDatabase(path_).ok());
  Execute("PRAGMA user_version = 7");
  const std::string before = Bytes();
  const absl::Status status = CheckDatabaseFile(path_);
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_THAT(std::string(status.message()),
              HasSubstr(path_ + " has format 7; this program knows"));
  EXPECT_EQ(Bytes(), before);
  const auto database = Database::Open(path_, Database::Access::kWrite).value();
  EXPECT_TRUE(absl::IsFailedPrecondition(UpdateSchema(*database)));
  EXPECT_TRUE(absl::IsFailedPrecondition(CheckSchema(*database)));
}

TEST_F(SchemaTest, WhatIsCutOffIsDamaged) {
  ASSERT_TRUE(MakeDatabase(path_).ok());
  const std::string whole = Bytes();
  for (const std::size_t size : {std::size_t{0}, std::size_t{50}}) {
    ASSERT_TRUE(WriteFile(path_, whole.substr(0, size)).ok());
    EXPECT_EQ(ErrorReason(CheckDatabaseFile(path_)), reason::kStoreDamaged) << size;
  }
  EXPECT_EQ(ErrorReason(CheckDatabaseFile(folder_.File("none"))), reason::kStoreUnavailable);
}

TEST_F(SchemaTest, TablesThatAreOtherThanTheyWereMadeAreDamage) {
  for (const char* change : {"DROP TABLE standing", "CREATE TABLE more(id INTEGER)",
                             "ALTER TABLE record RENAME COLUMN crc TO csc"}) {
    ASSERT_TRUE(MakeDatabase(path_).ok());
    Execute(change);
    const auto database = Database::Open(path_, Database::Access::kWrite).value();
    EXPECT_EQ(ErrorReason(UpdateSchema(*database)), reason::kStoreDamaged) << change;
    EXPECT_EQ(ErrorReason(CheckSchema(*database)), reason::kStoreDamaged) << change;
  }
}

}  // namespace schema_test
}  // namespace plumescout::server
