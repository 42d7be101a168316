// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/append_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout {
namespace append_file_test {

using testing::HasSubstr;

// No file of the process grows beyond this while it lives, as on a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(AppendFileTest, PiecesFollowOnEachOther) {
  const TempFolder folder;
  auto file = AppendFile::Create(folder.File("a"));
  ASSERT_TRUE(file.ok()) << file.status();
  EXPECT_TRUE(file->Append("one").ok());
  EXPECT_TRUE(file->Append("").ok());
  EXPECT_TRUE(file->Append(" two").ok());
  EXPECT_EQ(file->size_bytes(), 7);
  EXPECT_EQ(ReadFile(folder.File("a"), 100).value(), "one two");
}

TEST(AppendFileTest, WhatStandsThereStays) {
  const TempFolder folder;
  ASSERT_TRUE(WriteFile(folder.File("a"), "mine").ok());
  EXPECT_TRUE(absl::IsAlreadyExists(AppendFile::Create(folder.File("a")).status()));
  EXPECT_EQ(ReadFile(folder.File("a"), 100).value(), "mine");
  const absl::Status nowhere = AppendFile::Create(folder.File("no/such")).status();
  EXPECT_TRUE(absl::IsUnavailable(nowhere));
  EXPECT_THAT(std::string(nowhere.message()), HasSubstr("no/such: No such file"));
}

TEST(AppendFileTest, APieceThatDoesNotFitLeavesNothing) {
  const TempFolder folder;
  auto file = AppendFile::Create(folder.File("a"));
  ASSERT_TRUE(file.ok()) << file.status();
  ASSERT_TRUE(file->Append("12345678").ok());
  {
    const FullDisk disk(12);
    const absl::Status refused = file->Append("abcdefgh");
    EXPECT_TRUE(absl::IsUnavailable(refused));
    EXPECT_THAT(std::string(refused.message()), HasSubstr("a: File too large"));
  }
  EXPECT_EQ(ReadFile(folder.File("a"), 100).value(), "12345678");
  ASSERT_TRUE(file->Append("9").ok()) << "once there is room, it goes on";
  EXPECT_EQ(ReadFile(folder.File("a"), 100).value(), "123456789");
}

}  // namespace append_file_test
}  // namespace plumescout
