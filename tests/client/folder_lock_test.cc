// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/folder_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "tests/support/temp_folder.h"

namespace plumescout::client {
namespace folder_lock_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(FolderLockTest, OneHasTheFolderAndOthersHearWho) {
  const TempFolder folder;
  auto first = FolderLock::Take(folder.path());
  ASSERT_TRUE(first.ok()) << first.status();

  const absl::Status second = FolderLock::Take(folder.path()).status();

  EXPECT_TRUE(absl::IsFailedPrecondition(second)) << second;
  EXPECT_THAT(std::string(second.message()),
              AllOf(HasSubstr(folder.path()), HasSubstr(absl::StrCat("process ", getpid()))));
}

TEST(FolderLockTest, ItIsGivenBackAndMayBeMoved) {
  const TempFolder folder;
  {
    std::optional<FolderLock> kept = *FolderLock::Take(folder.path());
    FolderLock moved = *std::move(kept);
    kept.reset();
    EXPECT_FALSE(FolderLock::Take(folder.path()).ok());
  }
  EXPECT_TRUE(FolderLock::Take(folder.path()).ok());
}

TEST(FolderLockTest, AFolderThatIsNotThereIsNamed) {
  const absl::Status status = FolderLock::Take("/nonexistent/folder").status();
  EXPECT_TRUE(absl::IsUnavailable(status));
  EXPECT_THAT(std::string(status.message()), HasSubstr("/nonexistent/folder"));
}

}  // namespace folder_lock_test
}  // namespace plumescout::client
