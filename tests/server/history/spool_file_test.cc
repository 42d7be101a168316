// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/spool_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace spool_file_test {

std::string Contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(SpoolFileTest, HoldsWhatWasAppendedAndHasNoName) {
  const TempFolder folder;
  auto file = SpoolFile::Create(folder.path());
  ASSERT_TRUE(file.ok()) << file.status();
  ASSERT_TRUE(file->Append("one ").ok());
  SpoolFile moved = *std::move(file);
  ASSERT_TRUE(moved.Append("two").ok());
  EXPECT_EQ(Contents(moved.path()), "one two");
  EXPECT_EQ(Contents(moved.path()), "one two");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(SpoolFileTest, FolderThatIsNotThereIsNamed) {
  const auto file = SpoolFile::Create("/no/such/folder");
  EXPECT_TRUE(absl::IsUnavailable(file.status()));
  EXPECT_NE(file.status().message().find("/no/such/folder"), absl::string_view::npos);
}

}  // namespace spool_file_test
}  // namespace plumescout::server
