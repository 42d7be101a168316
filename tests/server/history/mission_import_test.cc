// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/mission_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "core/types/error_reason.h"
#include "server/history/import_desk.h"
#include "tests/server/history/exported_file.h"
#include "tests/server/history/past_run.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace mission_import_test {

using ::testing::HasSubstr;

class MissionImportTest : public testing::Test {
 protected:
  static RegistryHooks Hooks(MissionStore* store) {
    RegistryHooks hooks;
    hooks.store = store;
    return hooks;
  }
  ExportedFile Export() { return ExportFile(origin_, "hall", {run_.revision(), run_.digest}); }
  // Sends the file.
  absl::StatusOr<std::shared_ptr<MissionHost>> Import(const ExportedFile& file,
                                                      const std::string& id = "",
                                                      const StopFn& stop = NeverStop()) {
    auto import = desk_.Open();
    if (!import.ok()) return import.status();
    for (const v1::MissionFilePiece& piece : file.pieces) {
      const absl::Status added = (*import)->Add(piece);
      if (!added.ok()) return added;
    }
    return (*import)->Finish(file.end, {id, {"bob", ""}}, stop);
  }
  // A file of these bytes, with sums that fit.
  static ExportedFile FileOf(const std::string& bytes) {
    ExportedFile file;
    FileSum sum;
    v1::MissionFilePiece piece;
    piece.set_data(bytes);
    sum.Add(bytes);
    piece.set_crc32(sum.crc32());
    file.pieces = {piece};
    file.end.set_total_bytes(sum.bytes());
    file.end.set_sha256(sum.TakeSha256());
    return file;
  }
  void ExpectNothingChanged() {
    const auto missions = store_.List();
    ASSERT_TRUE(missions.ok());
    EXPECT_TRUE(missions->empty());
    EXPECT_TRUE(registry_.List("", 10).empty());
    EXPECT_TRUE(registry_.HoldRoom(kMemory_bytes).ok());
  }

  static constexpr std::int64_t kMemory_bytes = std::int64_t{2} << 30;

  MemoryStore origin_;
  const PastRun run_ = StoreRun(origin_);
  MemoryStore store_{/*is_durable=*/true};
  MissionRegistry registry_{WithMemory(kMemory_bytes), Hooks(&store_)};
  ImportDesk desk_{&store_, &registry_, {.max_bytes = 1 << 20, .max_at_once = 1}};
};

TEST_F(MissionImportTest, MissionGoesOnWhereItWasExported) {
  const auto host = Import(Export());
  ASSERT_TRUE(host.ok()) << host.status();
  EXPECT_EQ((*host)->id(), "hall");
  EXPECT_EQ((*host)->owner(), "bob");
  EXPECT_EQ((*host)->summary().revision, run_.revision());
  EXPECT_EQ((*host)->standing().state(), MissionState::kRunning);
  // And it is exported again as the same events.
  const ExportedFile again = ExportFile(store_, "hall", {run_.revision(), run_.digest});
  ASSERT_TRUE(again.status.ok());
  EXPECT_TRUE(Import(again, "copy").ok());
}

TEST_F(MissionImportTest, NameMayBeChosenAndHasToBeFree) {
  ASSERT_TRUE(Import(Export(), "other").ok());
  EXPECT_TRUE(registry_.Find("other").ok());
  const auto taken = Import(Export(), "other");
  EXPECT_TRUE(absl::IsAlreadyExists(taken.status())) << taken.status();
  EXPECT_THAT(std::string(taken.status().message()), HasSubstr("MISSION_EXISTS"));
  EXPECT_THAT(Import(Export(), "Not A Name").status(), Blames("start.mission_id"));
}

TEST_F(MissionImportTest, PiecesThatDoNotFitAreRefused) {
  const ExportedFile file = Export();
  auto import = desk_.Open();
  ASSERT_TRUE(import.ok()) << import.status();
  v1::MissionFilePiece piece = file.pieces[0];
  piece.set_offset_bytes(1);
  EXPECT_THAT((*import)->Add(piece), Blames("piece.offset_bytes"));
  piece = file.pieces[0];
  piece.set_crc32(piece.crc32() ^ 1);
  EXPECT_THAT((*import)->Add(piece), Blames("piece.crc32"));
}

TEST_F(MissionImportTest, FileThatIsNotWholeChangesNothing) {
  ExportedFile file = Export();
  ExportedFile short_file = file;
  short_file.end.set_total_bytes(file.end.total_bytes() + 1);
  EXPECT_THAT(Import(short_file).status(), Blames("end.total_bytes"));
  ExportedFile other = file;
  other.end.set_sha256(std::string(32, 'x'));
  EXPECT_THAT(Import(other).status(), Blames("end.sha256"));
  std::string bytes = file.bytes;
  EXPECT_EQ(ErrorReason(Import(FileOf(bytes.substr(0, bytes.size() - 1))).status()),
            reason::kExportDamaged);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  EXPECT_EQ(ErrorReason(Import(FileOf(bytes)).status()), reason::kExportDamaged);
  ExpectNothingChanged();
}

TEST_F(MissionImportTest, EventsThatMakeAnotherMissionChangeNothing) {
  const auto other = Import(ExportFile(origin_, "hall", {run_.revision(), run_.digest + 1}));
  EXPECT_TRUE(absl::IsDataLoss(other.status())) << other.status();
  EXPECT_THAT(std::string(other.status().message()), HasSubstr("digest"));
  EXPECT_TRUE(registry_.List("", 10).empty());
}

TEST_F(MissionImportTest, EventsThatCannotBeAppliedChangeNothing) {
  MemoryStore broken;
  const auto epoch = broken.Create("hall", EncodeMissionStart({.mission = "hall"}, {}));
  ASSERT_TRUE(AddEvents(broken, "hall", *epoch, {{1, RobotRemoved{"nobody"}}}).ok());
  const auto imported = Import(ExportFile(broken, "hall", {1, 0}));
  EXPECT_FALSE(imported.ok());
  ExpectNothingChanged();
}

TEST_F(MissionImportTest, WhatTheServerDoesNotAllowChangesNothing) {
  RegistryOptions options = WithMemory(kMemory_bytes);
  options.max_range_m = 1.0;
  MissionRegistry strict(options, Hooks(&store_));
  ImportDesk desk(&store_, &strict, {});
  auto import = desk.Open();
  ASSERT_TRUE(import.ok());
  const ExportedFile file = Export();
  for (const auto& piece : file.pieces) ASSERT_TRUE((*import)->Add(piece).ok());
  const auto refused = (*import)->Finish(file.end, {"", {"bob", ""}}, NeverStop());
  EXPECT_TRUE(absl::IsInvalidArgument(refused.status()));
  EXPECT_THAT(std::string(refused.status().message()), HasSubstr("max_range_m"));
  ExpectNothingChanged();
}

TEST_F(MissionImportTest, GivenUpItChangesNothing) {
  EXPECT_TRUE(absl::IsCancelled(Import(Export(), "", [] { return true; }).status()));
  ExpectNothingChanged();
}

TEST_F(MissionImportTest, FilesHaveALimit) {
  ExportedFile large = FileOf(std::string((1 << 20) + 1, 'x'));
  EXPECT_THAT(std::string(Import(large).status().message()), HasSubstr("LIMIT_REACHED"));
}

TEST_F(MissionImportTest, WhatACrashCutShortIsRemoved) {
  JournalStart start = *DecodeStart(EncodeMissionStart({.mission = "hall"}, {}));
  start.last_number = run_.revision();
  const auto epoch = store_.Create("half", EncodeStart(start));
  ASSERT_TRUE(epoch.ok());
  ASSERT_TRUE(AddEvents(store_, "half", *epoch, {run_.events[0]}).ok());
  ASSERT_TRUE(Import(Export(), "whole").ok());
  ASSERT_TRUE(store_.Create("new", EncodeMissionStart({.mission = "new"}, {})).ok());
  ASSERT_TRUE(DropUnfinishedImports(store_).ok());
  const auto missions = store_.List();
  ASSERT_TRUE(missions.ok());
  ASSERT_EQ(missions->size(), 2u);
  EXPECT_EQ((*missions)[0].key, "new");
  EXPECT_EQ((*missions)[1].key, "whole");
}

}  // namespace mission_import_test
}  // namespace plumescout::server
