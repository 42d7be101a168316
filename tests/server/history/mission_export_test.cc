// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/mission_export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/mcap/mcap_journal.h"
#include "tests/server/history/exported_file.h"
#include "tests/server/history/past_run.h"
#include "tests/support/memory_store.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace mission_export_test {

TEST(MissionExportTest, FileIsAJournalWithEveryEvent) {
  MemoryStore store;
  const PastRun run = StoreRun(store);
  const ExportedFile file = ExportFile(store, "hall", {run.revision(), run.digest});
  ASSERT_TRUE(file.status.ok()) << file.status;
  const TempFolder folder;
  auto reader = OpenAsFile(file.bytes, folder.File("journal"));
  ASSERT_TRUE(reader.ok()) << reader.status();
  EXPECT_EQ(reader->start()->mission, "hall");
  EXPECT_EQ(reader->start()->last_number, run.revision());
  EXPECT_EQ(reader->start()->last_digest, run.digest);
  for (const Event& event : run.events) {
    const auto read = reader->Next();
    ASSERT_TRUE(read.ok() && read->has_value()) << read.status();
    EXPECT_EQ((*read)->number, event.number);
  }
  const auto end = reader->Next();
  EXPECT_TRUE(end.ok() && !end->has_value());
}

TEST(MissionExportTest, PiecesFollowOnEachOtherAndTheEndVouchesForAll) {
  MemoryStore store;
  const PastRun run = StoreRun(store);
  const ExportedFile file = ExportFile(store, "hall", {run.revision(), run.digest});
  ASSERT_TRUE(file.status.ok()) << file.status;
  EXPECT_EQ(file.start.mission(), "missions/hall");
  EXPECT_EQ(file.start.revision(), run.revision());
  EXPECT_GT(file.start.expected_bytes(), 0);
  FileSum sum;
  for (const v1::MissionFilePiece& piece : file.pieces) {
    EXPECT_EQ(piece.offset_bytes(), sum.bytes());
    EXPECT_LE(piece.data().size(), MissionExport::kMaxPieceBytes);
    sum.Add(piece.data());
    EXPECT_EQ(piece.crc32(), sum.crc32());
  }
  EXPECT_EQ(file.end.total_bytes(), sum.bytes());
  EXPECT_EQ(file.end.sha256(), sum.TakeSha256());
}

TEST(MissionExportTest, MissionWithoutEventsIsAFileToo) {
  MemoryStore store;
  ASSERT_TRUE(store.Create("hall", EncodeMissionStart({.mission = "hall"}, {})).ok());
  const ExportedFile file = ExportFile(store, "hall", {});
  ASSERT_TRUE(file.status.ok()) << file.status;
  EXPECT_EQ(file.pieces.size(), 1u);
}

TEST(MissionExportTest, WhatCameLaterIsLeftOut) {
  MemoryStore store;
  StoreRun(store);
  const ExportedFile file = ExportFile(store, "hall", {3, 0});
  const TempFolder folder;
  auto reader = OpenAsFile(file.bytes, folder.File("journal"));
  ASSERT_TRUE(reader.ok()) << reader.status();
  int events = 0;
  for (auto event = reader->Next(); event.ok() && event->has_value(); event = reader->Next()) {
    ++events;
  }
  EXPECT_EQ(events, 3);
}

TEST(MissionExportTest, JournalThatIsTooShortHasNoEnd) {
  MemoryStore store;
  const PastRun run = StoreRun(store);
  const ExportedFile file = ExportFile(store, "hall", {run.revision() + 1, 0});
  EXPECT_TRUE(absl::IsDataLoss(file.status)) << file.status;
  EXPECT_TRUE(absl::IsNotFound(ExportFile(store, "attic", {1, 0}).status));
}

// Of default options.
absl::StatusOr<PastMission> MakePast() {
  PastMission past;
  past.mission = std::make_unique<Mission>(MissionOptions());
  return past;
}

TEST(MissionExportTest, AMissionAsMcapReplaysToTheSameState) {
  MemoryStore store;
  const PastRun run = StoreRun(store);
  const ExportedFile file = ExportFile(store, "hall", {run.revision(), run.digest}, MakePast);
  ASSERT_TRUE(file.status.ok()) << file.status;
  EXPECT_EQ(file.start.revision(), run.revision());
  EXPECT_EQ(file.end.total_bytes(), static_cast<std::int64_t>(file.bytes.size()));
  const TempFolder folder;
  std::ofstream(folder.File("mcap"), std::ios::binary) << file.bytes;
  auto reader = McapJournalReader::Open(folder.File("mcap"));
  ASSERT_TRUE(reader.ok()) << reader.status();
  EXPECT_EQ(reader->start()->mission, "hall");
  Mission mission{MissionOptions()};
  auto event = reader->Next();
  for (; event.ok() && *event; event = reader->Next()) {
    ASSERT_TRUE(mission.Apply((*event)->body).ok());
  }
  EXPECT_TRUE(event.ok()) << event.status();
  EXPECT_EQ(reader->torn_end(), "");
  EXPECT_EQ(mission.Digest(), run.digest);
}

TEST(MissionExportTest, AMissionThatIsAnotherHasNoEnd) {
  MemoryStore store;
  const PastRun run = StoreRun(store);
  const ExportedFile file = ExportFile(store, "hall", {run.revision(), run.digest + 1}, MakePast);
  EXPECT_TRUE(absl::IsDataLoss(file.status)) << file.status;
  const auto refuse = []() -> absl::StatusOr<PastMission> {
    return absl::ResourceExhaustedError("no room");
  };
  EXPECT_TRUE(absl::IsResourceExhausted(
      ExportFile(store, "hall", {run.revision(), run.digest}, refuse).status));
}

}  // namespace mission_export_test
}  // namespace plumescout::server
