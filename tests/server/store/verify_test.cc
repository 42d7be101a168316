// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/types/error_reason.h"
#include "formats/file_io.h"
#include "server/store/database.h"
#include "tests/server/store/store_work.h"
#include "tests/support/faulty_disk.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace verify_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class VerifyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto store = SqliteStore::Open(InFolder(folder_.path())).value();
    for (const char* key : {"house", "mill"}) {
      ASSERT_TRUE(store->Create(key, "header").ok());
      ASSERT_TRUE(AppendNow(*store, key, 1, 1, Records(key, 1, 300)).ok());
      ASSERT_TRUE(PutSnapshotNow(*store, key, 1, {200, 7, "state"}).ok());
    }
  }

  void Change(const std::string& sql) {
    const auto database = Database::Open(file_, Database::Access::kWrite).value();
    ASSERT_TRUE(database->Execute(sql).ok());
  }

  const TempFolder folder_;
  const std::string file_ = folder_.File("store.db");
  FaultyDisk disk_;
};

TEST_F(VerifyTest, AWholeStoreIsReadFromEndToEndAndNotChanged) {
  const std::string before = *ReadFile(file_, 1 << 24);
  std::vector<std::string> heard;
  const auto report = VerifyStore(folder_.path(), [&](absl::string_view what, std::int64_t,
                                                      std::int64_t) { heard.emplace_back(what); });
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_TRUE(report->is_whole());
  EXPECT_THAT(report->faults, IsEmpty());
  ASSERT_THAT(report->missions, SizeIs(2));
  EXPECT_EQ(report->missions[0].key, "house");
  EXPECT_EQ(report->missions[0].records, 300);
  EXPECT_EQ(report->missions[0].head, 300);
  EXPECT_EQ(report->missions[0].snapshots, 1);
  EXPECT_THAT(heard, ElementsAre(HasSubstr("structure"), "mission house", "mission mill"));
  EXPECT_EQ(*ReadFile(file_, 1 << 24), before);
}

TEST_F(VerifyTest, DamageIsReportedByMission) {
  Change("UPDATE record SET bytes = x'00' WHERE number = 123 AND mission = 1");
  Change("UPDATE snapshot SET bytes = x'00' WHERE mission = 2");
  const auto report = VerifyStore(folder_.path());
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_FALSE(report->is_whole());
  ASSERT_THAT(report->missions, SizeIs(2));
  EXPECT_EQ(report->missions[0].records, 122);
  EXPECT_THAT(std::string(report->missions[0].status.message()), HasSubstr("record 123 "));
  EXPECT_TRUE(report->missions[1].status.ok());
  EXPECT_EQ(report->missions[1].damaged_snapshots, 1);
  EXPECT_FALSE(report->missions[1].is_whole());
}

TEST_F(VerifyTest, MissionsThatAreGoneAreReported) {
  Change("DELETE FROM mission WHERE key = 'mill'");
  const auto report = VerifyStore(folder_.path());
  ASSERT_TRUE(report.ok()) << report.status();
  ASSERT_THAT(report->missions, SizeIs(2));
  EXPECT_EQ(ErrorReason(report->missions[1].status), reason::kStoreDamaged);
}

TEST_F(VerifyTest, ABrokenStructureIsReported) {
  Change("PRAGMA writable_schema = 1; DELETE FROM sqlite_schema WHERE name LIKE '%record_1'");
  EXPECT_TRUE(absl::IsDataLoss(VerifyStore(folder_.path()).status()) ||
              !VerifyStore(folder_.path())->is_whole());
}

TEST_F(VerifyTest, DamagedMarksAreReported) {
  std::string marks = *ReadFile(folder_.File("heads"), 1 << 20);
  marks[40] = static_cast<char>(marks[40] ^ 1);
  ASSERT_TRUE(WriteFile(folder_.File("heads"), marks).ok());
  const auto report = VerifyStore(folder_.path());
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_THAT(report->faults, ElementsAre(HasSubstr("heads: 1 damaged slots")));
}

TEST_F(VerifyTest, ARunningServerAndAnEmptyFolderAreRefused) {
  const TempFolder empty;
  EXPECT_TRUE(absl::IsNotFound(VerifyStore(empty.path()).status()));
  const auto store = SqliteStore::Open(InFolder(folder_.path())).value();
  const absl::Status status = VerifyStore(folder_.path()).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
}

TEST_F(VerifyTest, ATrimmedMissionIsWholeFromItsFirstRecordOn) {
  {
    const auto store = SqliteStore::Open(InFolder(folder_.path())).value();
    ASSERT_TRUE(PutSnapshotNow(*store, "house", 1, {250, 8, "state"}).ok());
    ASSERT_TRUE(TrimNow(*store, "house", 1).ok());
  }
  const auto report = VerifyStore(folder_.path());
  ASSERT_TRUE(report.ok()) << report.status();
  EXPECT_TRUE(report->is_whole());
  EXPECT_EQ(report->missions[0].records, 100);

  Change("UPDATE record SET bytes = x'00' WHERE number = 201 AND mission = 1");
  EXPECT_THAT(std::string(VerifyStore(folder_.path())->missions[0].status.message()),
              HasSubstr("record 201 "));
  Change("UPDATE progress SET base = 199 WHERE mission = 1");
  EXPECT_FALSE(VerifyStore(folder_.path())->is_whole());
}

}  // namespace verify_test
}  // namespace plumescout::server
