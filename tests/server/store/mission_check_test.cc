// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/mission_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/types/error_reason.h"
#include "server/store/schema.h"
#include "tests/server/store/store_work.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace mission_check_test {

using ::testing::HasSubstr;

class MissionCheckTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(MakeDatabase(path_).ok());
    database_ = Database::Open(path_, Database::Access::kWrite).value();
    rows_ = std::make_unique<MissionRows>(database_.get());
    row_ = rows_->Insert("house", "header").value();
    ASSERT_TRUE(rows_->AddRecords(row_, Records("house", 1, 10)).ok());
    row_.epoch = 4;
    ASSERT_TRUE(rows_->Save(row_).ok());
  }

  absl::Status Load(const std::string& key = "house") {
    return LoadMission(*rows_, marks_->Known(key), key).status();
  }

  const TempFolder folder_;
  const std::string path_ = folder_.File("store.db");
  FaultyDisk disk_;
  std::unique_ptr<Database> database_;
  std::unique_ptr<MissionRows> rows_;
  MissionRow row_;
  const std::unique_ptr<HeadMarks> marks_ = HeadMarks::Open(folder_.File("heads")).value();
};

TEST_F(MissionCheckTest, AMissionMayBeAheadOfItsMark) {
  const auto mission = LoadMission(*rows_, marks_->Known("house"), "house");
  ASSERT_TRUE(mission.ok()) << mission.status();
  EXPECT_EQ(mission->known.head, 10);
  EXPECT_EQ(mission->known.epoch, 4);
  EXPECT_EQ(mission->known.header, "header");
  ASSERT_TRUE(marks_->Set({"house", 4, 10, row_.chain}).ok());
  EXPECT_TRUE(Load().ok());
  ASSERT_TRUE(marks_->Set({"house", 2, 7, *rows_->ChainAt(row_, 7)}).ok());
  EXPECT_TRUE(Load().ok());
}

TEST_F(MissionCheckTest, AMissionThatIsShorterThanKnownIsDamaged) {
  ASSERT_TRUE(marks_->Set({"house", 4, 11, 0}).ok());
  const absl::Status shorter = Load();
  EXPECT_EQ(ErrorReason(shorter), reason::kStoreDamaged);
  for (const char* part : {"store.db ends at record 10, epoch 4, write 2 of mission house",
                           "heads knows", "of record 11, epoch 4, write 0"}) {
    EXPECT_THAT(std::string(shorter.message()), HasSubstr(part));
  }
  ASSERT_TRUE(marks_->Set({"house", 5, 10, row_.chain}).ok());
  EXPECT_EQ(ErrorReason(Load()), reason::kStoreDamaged);
  ASSERT_TRUE(marks_->Set({"house", 4, 10, row_.chain, 3}).ok());
  EXPECT_EQ(ErrorReason(Load()), reason::kStoreDamaged);
}

TEST_F(MissionCheckTest, AnotherHistoryIsDamage) {
  ASSERT_TRUE(marks_->Set({"house", 4, 7, 12345}).ok());
  EXPECT_EQ(ErrorReason(Load()), reason::kStoreDamaged);
}

TEST_F(MissionCheckTest, TheLastRecordMustBeThere) {
  ASSERT_TRUE(database_->Execute("DELETE FROM record WHERE number = 10").ok());
  const absl::Status status = Load();
  EXPECT_EQ(ErrorReason(status), reason::kStoreDamaged);
  EXPECT_THAT(std::string(status.message()), HasSubstr("record 10 of mission house"));
}

TEST_F(MissionCheckTest, AMissionThatIsGoneIsMissedIfItIsKnown) {
  EXPECT_TRUE(absl::IsNotFound(Load("mill")));
  ASSERT_TRUE(marks_->Set({"mill", 1, 3, 0}).ok());
  const absl::Status status = Load("mill");
  EXPECT_EQ(ErrorReason(status), reason::kStoreDamaged);
  EXPECT_THAT(std::string(status.message()), HasSubstr("does not hold mission mill"));
}

}  // namespace mission_check_test
}  // namespace plumescout::server
