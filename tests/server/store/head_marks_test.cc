// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/head_marks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "absl/strings/str_cat.h"
#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace head_marks_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::uint64_t kMaxBytes = 1 << 20;

TEST(HeadMarks, OutliveTheProcess) {
  const TempFolder folder;
  const std::string path = folder.File("heads");
  const HeadMark house{"house", 3, 1234567890123, 0xDEADBEEF, 1234567890124};
  const HeadMark mill{std::string(kMaxMissionKeyBytes, 'm'), 1, 0, 0};
  {
    const auto marks = *HeadMarks::Open(path);
    EXPECT_THAT(marks->All(), IsEmpty());
    EXPECT_TRUE(marks->Set({"house", 1, 5, 6}).ok());
    EXPECT_TRUE(marks->Set(mill).ok());
    EXPECT_TRUE(marks->Set(house).ok());
  }
  const auto marks = *HeadMarks::OpenToRead(path);
  EXPECT_THAT(marks->All(), ElementsAre(house, mill));
  EXPECT_EQ(marks->Find("house"), house);
  EXPECT_EQ(marks->Find("barn"), std::nullopt);
  EXPECT_EQ(marks->damaged_slots(), 0U);
}

TEST(HeadMarks, SlotsThatAreClearedAreUsedAgain) {
  const TempFolder folder;
  const std::string path = folder.File("heads");
  const auto marks = *HeadMarks::Open(path);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(marks->Set({absl::StrCat("m", i), 1, i, 0}).ok());
  const std::size_t size = ReadFile(path, kMaxBytes)->size();
  EXPECT_TRUE(marks->Clear("m1").ok());
  EXPECT_TRUE(marks->Clear("m1").ok());
  EXPECT_EQ(marks->Find("m1"), std::nullopt);
  EXPECT_THAT((*HeadMarks::OpenToRead(path))->All(), SizeIs(3));
  EXPECT_TRUE(marks->Set({"new", 1, 9, 0}).ok());
  EXPECT_EQ(ReadFile(path, kMaxBytes)->size(), size);
  EXPECT_THAT((*HeadMarks::OpenToRead(path))->All(), SizeIs(4));
}

TEST(HeadMarks, ADamagedSlotTellsNothing) {
  const TempFolder folder;
  const std::string path = folder.File("heads");
  {
    const auto marks = *HeadMarks::Open(path);
    EXPECT_TRUE(marks->Set({"a", 1, 100, 7}).ok());
    EXPECT_TRUE(marks->Set({"b", 1, 200, 8}).ok());
  }
  const std::string whole = *ReadFile(path, kMaxBytes);
  for (std::size_t at = 0; at < whole.size() / 2; ++at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    ASSERT_TRUE(WriteFile(path, bytes).ok());
    const auto marks = *HeadMarks::OpenToRead(path);
    EXPECT_EQ(marks->damaged_slots(), 1U) << at;
    EXPECT_THAT(marks->All(), ElementsAre(HeadMark{"b", 1, 200, 8})) << at;
  }
  ASSERT_TRUE(WriteFile(path, whole.substr(0, whole.size() - 1)).ok());
  const auto marks = *HeadMarks::Open(path);
  EXPECT_THAT(marks->All(), ElementsAre(HeadMark{"a", 1, 100, 7}));
  EXPECT_TRUE(marks->Set({"c", 1, 300, 9}).ok());
  EXPECT_THAT((*HeadMarks::OpenToRead(path))->All(), SizeIs(2));
}

TEST(HeadMarks, OfTwoSlotsTheNewerCounts) {
  const TempFolder folder;
  const std::string older = folder.File("older");
  const std::string newer = folder.File("newer");
  EXPECT_TRUE((*HeadMarks::Open(older))->Set({"a", 2, 10, 1}).ok());
  EXPECT_TRUE((*HeadMarks::Open(newer))->Set({"a", 2, 11, 2}).ok());
  const std::string both = folder.File("both");
  for (const bool newer_first : {false, true}) {
    const std::string first = *ReadFile(newer_first ? newer : older, kMaxBytes);
    const std::string second = *ReadFile(newer_first ? older : newer, kMaxBytes);
    ASSERT_TRUE(WriteFile(both, first + second).ok());
    EXPECT_THAT((*HeadMarks::OpenToRead(both))->All(), ElementsAre(HeadMark{"a", 2, 11, 2}));
  }
}

}  // namespace head_marks_test
}  // namespace plumescout::server
