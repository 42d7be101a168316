// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/log_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "formats/file_io.h"
#include "tests/client/log_traffic.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace log_store_test {

using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::size_t kMaxFile_bytes = 1 << 20;

class LogStoreTest : public ::testing::Test {
 protected:
  absl::StatusOr<OpenedLog> TryOpen(const RobotId& robot = "scout") {
    return OpenLog(options_, "hall", robot, /*new_epoch=*/++drawn_, disk_.System());
  }
  OpenedLog Open() {
    auto opened = TryOpen();
    EXPECT_TRUE(opened.ok()) << opened.status();
    return opened.ok() ? *std::move(opened) : OpenedLog{};
  }
  static void Append(LogStore& store, std::int64_t first, std::int64_t last) {
    for (std::int64_t number = first; number <= last; ++number) {
      ASSERT_TRUE(store.Append(EntryAt(number)).ok());
    }
  }
  // What an earlier process left.
  void Leave(std::int64_t first, std::int64_t last) { Append(*Open().store, first, last); }
  void Flip(const std::string& path, std::size_t at) {
    std::string bytes = *ReadFile(path, kMaxFile_bytes);
    ASSERT_LT(at, bytes.size());
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    ASSERT_TRUE(WriteFile(path, bytes).ok());
  }
  std::vector<std::string> Segments() const { return SegmentsIn(options_.folder); }

  const TempFolder folder_;
  LogStoreOptions options_{.folder = folder_.File("log"), .segment_bytes = 400};
  FailingDisk disk_;
  std::int64_t drawn_ = 0;
};

TEST_F(LogStoreTest, BeginsALogAndGoesOnWithIt) {
  {
    const OpenedLog opened = Open();
    EXPECT_EQ(opened.log.epoch, 1);
    EXPECT_THAT(opened.log.entries, IsEmpty());
    Append(*opened.store, 1, 20);
    ASSERT_TRUE(opened.store->Append(LogMark{15, 12}).ok());
  }
  EXPECT_THAT(Segments(), SizeIs(Ge(3U)));

  const OpenedLog again = Open();
  EXPECT_EQ(again.log.epoch, 1);
  EXPECT_EQ(again.log.last_sequence, 20);
  EXPECT_EQ(again.log.applied_sequence, 15);
  EXPECT_EQ(again.log.durable_sequence, 12);
  ASSERT_THAT(again.log.entries, SizeIs(20));
  EXPECT_EQ(again.log.entries[7], EntryAt(8));
  EXPECT_THAT(again.damage, IsEmpty());
}

TEST_F(LogStoreTest, ManyProcessesAfterEachOther) {
  for (std::int64_t number = 1; number <= 5; ++number) Leave(number, number);

  EXPECT_THAT(NumbersOf(Open().log.entries), ElementsAre(1, 2, 3, 4, 5));
}

TEST_F(LogStoreTest, SegmentsGoOnceNothingInThemIsNeeded) {
  OpenedLog opened = Open();
  Append(*opened.store, 1, 40);
  const std::size_t all = Segments().size();

  opened.store->DropBefore(20);

  EXPECT_LT(Segments().size(), all);
  opened = {};
  const OpenedLog again = Open();
  EXPECT_LE(again.log.entries.front().sequence, 20);
  EXPECT_GT(again.log.entries.front().sequence, 10);
  EXPECT_EQ(again.log.entries.back().sequence, 40);

  again.store->DropBefore(41);
  EXPECT_THAT(Segments(), IsEmpty());
}

TEST_F(LogStoreTest, NumbersAreRememberedWhenTheirEntriesAreGone) {
  {
    const OpenedLog opened = Open();
    Append(*opened.store, 1, 40);
    opened.store->DropBefore(41);
    ASSERT_TRUE(opened.store->Append(LogMark{40, 40}).ok());
  }
  EXPECT_EQ(Open().log.last_sequence, 40);
}

TEST_F(LogStoreTest, ARenumberingSurvives) {
  {
    const OpenedLog opened = Open();
    Append(*opened.store, 1, 20);
    ASSERT_TRUE(opened.store->Append(NumberedRenumbering{1, {15, 115}}).ok());
    Append(*opened.store, 121, 130);
    opened.store->DropBefore(115);
    EXPECT_THAT(Segments(), SizeIs(Ge(2U)));
  }
  const OpenedLog again = Open();
  EXPECT_EQ(again.log.entries.front().sequence, 115);
  EXPECT_EQ(again.log.entries.front().sample_time_ns, EntryAt(15).sample_time_ns);
  EXPECT_THAT(again.log.entries, SizeIs(16));
  EXPECT_EQ(again.store->renumberings(), 1);
  again.store->DropBefore(131);
  EXPECT_THAT(Segments(), IsEmpty());
}

TEST_F(LogStoreTest, ASecondProcessIsRefused) {
  const OpenedLog opened = Open();
  const absl::Status second = TryOpen().status();
  EXPECT_TRUE(absl::IsFailedPrecondition(second)) << second;
  EXPECT_THAT(std::string(second.message()), HasSubstr("in use by process"));
}

TEST_F(LogStoreTest, AnotherRobotsLogIsRefusedAndLeftAlone) {
  Leave(1, 3);
  const absl::Status other = TryOpen("other").status();
  EXPECT_TRUE(absl::IsFailedPrecondition(other)) << other;
  EXPECT_THAT(std::string(other.message()), HasSubstr("log-00000001"));
  EXPECT_THAT(std::string(other.message()), HasSubstr("\"scout\" in mission \"hall\""));
  EXPECT_THAT(NumbersOf(Open().log.entries), ElementsAre(1, 2, 3));
}

TEST_F(LogStoreTest, ALaterVersionIsRefusedByNameAndLeftAlone) {
  Leave(1, 3);
  const std::string path = Segments()[0];
  Flip(path, 8);  // the version
  const std::string bytes = *ReadFile(path, kMaxFile_bytes);

  const absl::Status status = TryOpen().status();

  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("version 17"));
  EXPECT_EQ(*ReadFile(path, kMaxFile_bytes), bytes);
}

TEST_F(LogStoreTest, AFolderThatCannotBeMadeIsNamed) {
  options_.folder = folder_.File("log/below");
  ASSERT_TRUE(WriteFile(folder_.File("log"), "in the way").ok());
  EXPECT_THAT(std::string(TryOpen().status().message()), HasSubstr(options_.folder));
}

TEST_F(LogStoreTest, AHalfWrittenRecordIsCutOffOnce) {
  Leave(1, 3);
  const std::string path = Segments()[0];
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 5);

  {
    const OpenedLog opened = Open();
    EXPECT_THAT(NumbersOf(opened.log.entries), ElementsAre(1, 2));
    ASSERT_THAT(opened.damage, SizeIs(1));
    EXPECT_THAT(std::string(opened.damage[0].message()), HasSubstr(path));
    Append(*opened.store, 3, 4);  // the number was never told to anybody, or the server knows
  }
  const OpenedLog again = Open();
  EXPECT_THAT(NumbersOf(again.log.entries), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(again.damage, IsEmpty());
}

TEST_F(LogStoreTest, ASegmentThatWasOnlyBegunIsCutAway) {
  Leave(1, 3);
  ASSERT_TRUE(WriteFile(folder_.File("log/log-00000002"), "PLUME").ok());

  EXPECT_THAT(NumbersOf(Open().log.entries), ElementsAre(1, 2, 3));
  EXPECT_THAT(Segments(), SizeIs(1));
}

TEST_F(LogStoreTest, DamageInTheMiddleIsNamedAndTheRestKept) {
  Leave(1, 20);
  const std::string path = Segments()[1];
  Flip(path, std::filesystem::file_size(path) - 3);  // in its last record

  const OpenedLog opened = Open();

  EXPECT_THAT(opened.log.entries, SizeIs(19));
  EXPECT_EQ(opened.log.last_sequence, 20);
  ASSERT_THAT(opened.damage, SizeIs(1));
  EXPECT_TRUE(absl::IsDataLoss(opened.damage[0]));
  EXPECT_THAT(std::string(opened.damage[0].message()), HasSubstr(path));
}

TEST_F(LogStoreTest, OneFlippedBitNeverChangesWhatIsRead) {
  Leave(1, 12);
  const std::string path = Segments()[1];
  const std::string whole = *ReadFile(path, kMaxFile_bytes);
  const std::vector<Observation> all = Open().log.entries;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    Flip(path, at);
    const auto opened = TryOpen();
    ASSERT_TRUE(opened.ok() || absl::IsFailedPrecondition(opened.status())) << opened.status();
    if (opened.ok()) {
      EXPECT_THAT(opened->damage, SizeIs(1)) << at;
      for (const Observation& entry : opened->log.entries) {
        EXPECT_EQ(entry, all[static_cast<std::size_t>(entry.sequence - 1)]);
      }
    }
    ASSERT_TRUE(WriteFile(path, whole).ok());
  }
}

TEST_F(LogStoreTest, AMissingSegmentIsNamed) {
  Leave(1, 20);
  std::filesystem::remove(Segments()[1]);

  const OpenedLog opened = Open();

  ASSERT_THAT(opened.damage, SizeIs(1));
  EXPECT_THAT(std::string(opened.damage[0].message()), HasSubstr("between 1 and 3"));
  EXPECT_EQ(opened.log.last_sequence, 20);
}

TEST_F(LogStoreTest, AFullDiskLosesNothingThatWasWritten) {
  OpenedLog opened = Open();
  Append(*opened.store, 1, 5);
  disk_.full = true;
  for (int i = 0; i < 3; ++i) {
    disk_.half_writes = i;
    EXPECT_TRUE(absl::IsUnavailable(opened.store->Append(EntryAt(6))));
  }
  EXPECT_EQ(opened.store->failed_syncs(), 0);
  disk_.full = false;
  Append(*opened.store, 6, 30);

  opened = {};
  const OpenedLog again = Open();
  EXPECT_THAT(again.log.entries, SizeIs(30));
  EXPECT_THAT(again.damage, IsEmpty());
}

TEST_F(LogStoreTest, WhatASyncFailedForMayBeWrittenAgain) {
  OpenedLog opened = Open();
  Append(*opened.store, 1, 3);
  ASSERT_TRUE(opened.store->Sync().ok());
  Append(*opened.store, 4, 5);
  const NumberedRenumbering numbered = {1, {2, 52}};
  ASSERT_TRUE(opened.store->Append(numbered).ok());
  disk_.syncs = false;
  EXPECT_TRUE(absl::IsUnavailable(opened.store->Sync()));
  EXPECT_EQ(opened.store->failed_syncs(), 1);
  disk_.syncs = true;
  ASSERT_TRUE(opened.store->Append(numbered).ok());
  Append(*opened.store, 54, 60);

  opened = {};
  const OpenedLog again = Open();
  EXPECT_EQ(NumbersOf(again.log.entries),
            (std::vector<std::int64_t>{52, 53, 54, 55, 56, 57, 58, 59, 60}));
  EXPECT_EQ(again.log.entries[2].sample_time_ns, EntryAt(4).sample_time_ns);
}

// The same if the bytes of that sync are lost indeed.
TEST_F(LogStoreTest, WhatASyncFailedForMayBeGone) {
  OpenedLog opened = Open();
  Append(*opened.store, 1, 3);
  ASSERT_TRUE(opened.store->Sync().ok());
  const std::string path = Segments()[0];
  const auto synced_bytes = std::filesystem::file_size(path);
  const NumberedRenumbering numbered = {1, {2, 52}};
  ASSERT_TRUE(opened.store->Append(numbered).ok());
  disk_.syncs = false;
  EXPECT_FALSE(opened.store->Sync().ok());
  std::filesystem::resize_file(path, synced_bytes);
  disk_.syncs = true;
  ASSERT_TRUE(opened.store->Append(numbered).ok());
  Append(*opened.store, 54, 55);

  opened = {};
  EXPECT_THAT(NumbersOf(Open().log.entries), ElementsAre(52, 53, 54, 55));
}

}  // namespace log_store_test
}  // namespace plumescout::client
