// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "formats/file_io.h"
#include "server/store/sqlite_store.h"
#include "tests/server/stored_run.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {
namespace store_command_test {

using ::testing::HasSubstr;

class StoreCommandTest : public testing::Test {
 protected:
  // Returns the exit code.
  int Run(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "store");
    out_.str("");
    err_.str("");
    return RunStoreCommand(static_cast<int>(arguments.size()), arguments.data(), out_, err_);
  }
  void MakeStore() {
    auto store = SqliteStore::Open({.folder = folder_.path()});
    ASSERT_TRUE(store.ok()) << store.status();
    PutMission(**store, "hall", {}, {{1, RobotRegistered{"r1", 0.2, 1, 0}}});
  }

  const TempFolder folder_;
  const std::string data_ = folder_.path();
  std::ostringstream out_, err_;
};

TEST_F(StoreCommandTest, ListTellsWhatIsThere) {
  MakeStore();
  EXPECT_EQ(Run({"list", "--data", data_.c_str()}), 0) << err_.str();
  EXPECT_THAT(out_.str(), HasSubstr("MISSION  EVENTS"));
  EXPECT_THAT(out_.str(), HasSubstr("hall     1"));
  EXPECT_EQ(Run({"list", "--data", data_.c_str(), "--output", "json"}), 0);
  const auto list = nlohmann::json::parse(out_.str());
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["mission"], "hall");
  EXPECT_EQ(list[0]["events"], 1);
}

TEST_F(StoreCommandTest, WholeStoreIsVerified) {
  MakeStore();
  EXPECT_EQ(Run({"verify", "--data", data_.c_str()}), 0) << out_.str() << err_.str();
  EXPECT_THAT(out_.str(), HasSubstr("store.db is whole\n"));
  EXPECT_EQ(Run({"verify", "--data", data_.c_str(), "--output", "json"}), 0);
  const auto report = nlohmann::json::parse(out_.str());
  EXPECT_TRUE(report["whole"]);
  EXPECT_EQ(report["missions"][0]["events_read"], 1);
}

TEST_F(StoreCommandTest, DamageIsAnErrorThatIsNamed) {
  MakeStore();
  const std::string file = folder_.File("store.db");
  std::string bytes = *ReadFile(file, 1 << 24);
  for (std::size_t i = bytes.size() / 2; i < bytes.size(); ++i) bytes[i] = '\x55';
  ASSERT_TRUE(WriteFile(file, bytes).ok());
  EXPECT_EQ(Run({"verify", "--data", data_.c_str()}), 1);
  EXPECT_THAT(out_.str() + err_.str(), HasSubstr("store.db"));
}

TEST_F(StoreCommandTest, FolderWithoutAStoreIsAnError) {
  EXPECT_EQ(Run({"list", "--data", data_.c_str()}), 1);
  EXPECT_THAT(err_.str(), HasSubstr(data_));
  EXPECT_EQ(Run({"verify", "--data", data_.c_str()}), 1);
}

TEST_F(StoreCommandTest, WrongCommandLinesHaveTheirExitCode) {
  EXPECT_EQ(Run({}), 2);
  EXPECT_EQ(Run({"mend"}), 2);
  EXPECT_EQ(Run({"list", "--output", "xml"}), 2);
  EXPECT_EQ(Run({"verify", "--help"}), 0);
}

}  // namespace store_command_test
}  // namespace plumescout::server
