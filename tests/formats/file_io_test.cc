// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/file_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/temp_folder.h"

namespace plumescout {
namespace file_io_test {

using testing::HasSubstr;

constexpr std::uint64_t kNoLimit = 1 << 20;

TEST(FileIo, EveryByteComesBack) {
  const TempFolder folder;
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  ASSERT_TRUE(WriteFile(folder.File("a"), bytes).ok());
  EXPECT_EQ(*ReadFile(folder.File("a"), kNoLimit), bytes);
}

TEST(FileIo, AnEmptyFileIsEmpty) {
  const TempFolder folder;
  ASSERT_TRUE(WriteFile(folder.File("a"), "").ok());
  EXPECT_EQ(*ReadFile(folder.File("a"), kNoLimit), "");
}

TEST(FileIo, AMissingFileIsNamed) {
  const TempFolder folder;
  const auto bytes = ReadFile(folder.File("absent"), kNoLimit);
  EXPECT_EQ(bytes.status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(bytes.status().message()), HasSubstr("absent"));
}

TEST(FileIo, AFolderIsNoFile) {
  const TempFolder folder;
  EXPECT_EQ(ReadFile(folder.path(), kNoLimit).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(FileIo, AFileBeyondTheLimitIsNotRead) {
  const TempFolder folder;
  ASSERT_TRUE(WriteFile(folder.File("a"), "12345").ok());
  EXPECT_TRUE(ReadFile(folder.File("a"), 5).ok());
  EXPECT_EQ(ReadFile(folder.File("a"), 4).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(FileIo, WritingReplacesAndLeavesNothingBeside) {
  const TempFolder folder;
  ASSERT_TRUE(WriteFile(folder.File("a"), "a longer first version").ok());
  ASSERT_TRUE(WriteFile(folder.File("a"), "second").ok());
  EXPECT_EQ(*ReadFile(folder.File("a"), kNoLimit), "second");
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(FileIo, WritingIntoAMissingFolderIsNotFound) {
  const TempFolder folder;
  EXPECT_EQ(WriteFile(folder.File("absent/a"), "x").code(), absl::StatusCode::kNotFound);
}

TEST(FileIo, FoldersAreMadeWithThoseAboveThem) {
  const TempFolder folder;
  EXPECT_TRUE(MakeFolder(folder.File("a/b/c")).ok());
  EXPECT_TRUE(MakeFolder(folder.File("a/b/c")).ok());
  EXPECT_TRUE(std::filesystem::is_directory(folder.File("a/b/c")));
}

TEST(FileIo, AFolderCannotReplaceAFile) {
  const TempFolder folder;
  ASSERT_TRUE(WriteFile(folder.File("a"), "x").ok());
  EXPECT_EQ(MakeFolder(folder.File("a")).code(), absl::StatusCode::kUnavailable);
}

}  // namespace file_io_test
}  // namespace plumescout
