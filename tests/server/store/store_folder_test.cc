// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store/store_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <optional>

#include "absl/strings/str_cat.h"
#include "formats/file_io.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace store_folder_test {

using ::testing::HasSubstr;

TEST(StoreFolder, IsMadeForItsOwnerOnly) {
  const TempFolder temp;
  const std::string folder = temp.File("state/plumescout");
  ASSERT_TRUE(FolderLock::Take(folder).ok());
  struct stat entry {};
  ASSERT_EQ(stat(folder.c_str(), &entry), 0);
  EXPECT_EQ(entry.st_mode & 0777U, 0700U);
}

TEST(StoreFolder, ASecondOwnerIsToldOfTheFirst) {
  const TempFolder temp;
  std::optional<FolderLock> first = FolderLock::Take(temp.path()).value();
  const absl::Status second = FolderLock::Take(temp.path()).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(second)) << second;
  EXPECT_THAT(std::string(second.message()), HasSubstr(temp.path()));
  EXPECT_THAT(std::string(second.message()), HasSubstr(absl::StrCat("process ", getpid(), " on ")));
  first.reset();
  EXPECT_TRUE(FolderLock::Take(temp.path()).ok());
}

TEST(StoreFolder, WhatIsNoFolderIsNamed) {
  const TempFolder temp;
  ASSERT_TRUE(WriteFile(temp.File("file"), "x").ok());
  const absl::Status taken = FolderLock::Take(temp.File("file")).status();
  EXPECT_TRUE(absl::IsUnavailable(taken)) << taken;
  EXPECT_THAT(std::string(taken.message()), HasSubstr(temp.File("file")));
  const absl::Status below = FolderLock::Take(temp.File("file/store")).status();
  EXPECT_FALSE(below.ok());
  EXPECT_THAT(std::string(below.message()), HasSubstr(temp.File("file")));
}

TEST(StoreFolder, AFolderWithoutRightsIsNamed) {
  if (geteuid() == 0) GTEST_SKIP() << "root has all rights";
  const TempFolder temp;
  ASSERT_EQ(chmod(temp.path().c_str(), 0500), 0);
  const absl::Status taken = FolderLock::Take(temp.path()).status();
  EXPECT_TRUE(absl::IsPermissionDenied(taken)) << taken;
  EXPECT_THAT(std::string(taken.message()), HasSubstr(temp.File("lock")));
  const absl::Status below = FolderLock::Take(temp.File("below")).status();
  EXPECT_TRUE(absl::IsPermissionDenied(below)) << below;
}

TEST(StoreFolder, WhereThereIsNoStoreNoneIsMade) {
  const TempFolder temp;
  EXPECT_TRUE(absl::IsNotFound(FolderLock::TakeExisting(temp.File("none")).status()));
  EXPECT_FALSE(FileExists(temp.File("none")));
}

TEST(StoreFolder, TheSizesOfAllFilesAreAdded) {
  const TempFolder temp;
  EXPECT_EQ(StoreDiskBytes(temp.path()), 0);
  ASSERT_TRUE(WriteFile(DatabaseFile(temp.path()), "12345").ok());
  ASSERT_TRUE(WriteFile(DatabaseFile(temp.path()) + "-wal", "123").ok());
  ASSERT_TRUE(WriteFile(HeadMarksFile(temp.path()), "1").ok());
  EXPECT_EQ(StoreDiskBytes(temp.path()), 9);
  EXPECT_TRUE(SyncFolder(temp.path()).ok());
  EXPECT_FALSE(SyncFolder(temp.File("none")).ok());
}

}  // namespace store_folder_test
}  // namespace plumescout::server
