// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/web/static_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace static_files_test {

namespace fs = std::filesystem;

class StaticFilesTest : public testing::Test {
 protected:
  StaticFilesTest() { fs::create_directories(folder_ / "assets"); }

  void Write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  }

  const TempFolder temporary_;
  const fs::path folder_ = temporary_.File("pages");
};

TEST_F(StaticFilesTest, FilesAreFoundByTheirPaths) {
  Write("index.html", "<p>");
  Write("assets/console.js", "1;");
  const auto files = StaticFiles::Load(folder_);
  ASSERT_TRUE(files.ok()) << files.status();
  ASSERT_NE(files->Find("/"), nullptr);
  EXPECT_EQ(files->Find("/"), files->Find("/index.html"));
  EXPECT_EQ(files->Find("/")->content, "<p>");
  EXPECT_EQ(files->Find("/")->type, "text/html; charset=utf-8");
  EXPECT_EQ(files->Find("/")->caching, "no-cache");
  const StaticFile* const script = files->Find("/assets/console.js");
  ASSERT_NE(script, nullptr);
  EXPECT_EQ(script->type, "text/javascript; charset=utf-8");
  EXPECT_THAT(script->caching, ::testing::HasSubstr("immutable"));
}

TEST_F(StaticFilesTest, ThoseInstalledWithTheProgramAreForWhoNamesNoFolder) {
  Write("index.html", "named");
  const std::string program = temporary_.File("usr/bin/plumescout-server");
  const auto none = StaticFiles::LoadOrInstalled("", program);
  ASSERT_TRUE(none.ok()) << none.status();
  EXPECT_TRUE(none->empty());
  const fs::path installed = temporary_.File("usr/share/plumescout/console");
  fs::create_directories(installed);
  EXPECT_FALSE(StaticFiles::LoadOrInstalled("", program).ok()) << "there is no page";
  std::ofstream(installed / "index.html") << "installed";
  EXPECT_EQ(StaticFiles::LoadOrInstalled("", program)->Find("/")->content, "installed");
  EXPECT_EQ(StaticFiles::LoadOrInstalled(folder_, program)->Find("/")->content, "named");
}

TEST_F(StaticFilesTest, NothingElseIsServed) {
  Write("index.html", "<p>");
  Write(".secret.html", "x");
  Write("key.pem", "x");
  const auto files = StaticFiles::Load(folder_);
  ASSERT_TRUE(files.ok()) << files.status();
  for (const char* path : {"/.secret.html", "/key.pem", "/assets", "/assets/", "/../index.html",
                           "/%2e%2e/index.html", "", "index.html"}) {
    EXPECT_EQ(files->Find(path), nullptr) << path;
  }
}

TEST_F(StaticFilesTest, FolderNeedsAPage) {
  for (const fs::path& folder : {folder_, folder_ / "missing"}) {
    const absl::Status refused = StaticFiles::Load(folder).status();
    EXPECT_TRUE(absl::IsInvalidArgument(refused)) << refused;
    EXPECT_THAT(std::string(refused.message()), ::testing::HasSubstr("has no index.html"));
  }
}

TEST_F(StaticFilesTest, TooManyFilesAreRefused) {
  Write("index.html", "<p>");
  for (std::size_t i = 0; i < StaticFiles::kMaxFiles; ++i) Write(std::to_string(i) + ".txt", "");
  EXPECT_TRUE(absl::IsResourceExhausted(StaticFiles::Load(folder_).status()));
}

TEST(StaticFiles, OfNothingThereAreNone) {
  EXPECT_TRUE(StaticFiles().empty());
  EXPECT_EQ(StaticFiles().Find("/"), nullptr);
}

}  // namespace static_files_test
}  // namespace plumescout::server
