// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bags/sqlite_bag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "absl/strings/str_cat.h"
#include "tests/lab/bags/bag_files.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace sqlite_bag_test {

using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::set<std::string> kWanted = {"/scan", "/PID/Sensor_reading"};

class SqliteBagTest : public ::testing::Test {
 protected:
  BagReading Read(const std::string& path, const std::set<std::string>& wanted) {
    auto bag = OpenSqliteBag(path, wanted);
    EXPECT_TRUE(bag.ok()) << bag.status();
    if (!bag.ok()) return {};
    bag_ = *std::move(bag);
    return ReadAll(*bag_);
  }

  TempFolder folder_;
  const std::string path_ = folder_.File("bag");
  std::unique_ptr<BagReader> bag_;
};

TEST_F(SqliteBagTest, MessagesOfWantedTopicsComeInOrder) {
  const std::vector<BagMessage> all = RoomBag(20);
  WriteSqliteBag(path_, all);
  const BagReading reading = Read(path_, {"/tf", "/tf_static", "/scan", "/PID/Sensor_reading"});
  EXPECT_TRUE(reading.end.ok()) << reading.end;
  EXPECT_EQ(reading.torn_end, "");
  EXPECT_EQ(reading.messages, all);
  EXPECT_EQ(bag_->share_read(), 1.0);
  EXPECT_THAT(Read(path_, kWanted).messages, SizeIs(40));
  EXPECT_EQ(bag_->topics().at("/tf"), "tf2_msgs/msg/TFMessage");
}

TEST_F(SqliteBagTest, WhatIsNoCdrIsCountedAndPassedOver) {
  WriteSqliteBag(path_, RoomBag(3), {{"/scan", "json"}});
  EXPECT_THAT(Read(path_, kWanted).messages, SizeIs(3));
  EXPECT_EQ(bag_->unknown_encodings().at("json"), 3);
}

TEST_F(SqliteBagTest, OfAFileThatWasCutOffTheFrontIsRead) {
  const std::vector<BagMessage> all = RoomBag(200);
  WriteSqliteBag(path_, all);
  CutFile(path_, 0.7, folder_.File("cut"), /*page_bytes=*/4096);
  const BagReading reading =
      Read(folder_.File("cut"), {"/tf", "/tf_static", "/scan", "/PID/Sensor_reading"});
  EXPECT_TRUE(reading.end.ok()) << reading.end;
  EXPECT_THAT(reading.torn_end, HasSubstr("cut off"));
  ASSERT_GT(reading.messages.size(), all.size() / 3);
  ASSERT_LT(reading.messages.size(), all.size());
  for (std::size_t i = 0; i < reading.messages.size(); ++i) {
    ASSERT_EQ(reading.messages[i], all[i]) << i;
  }
}

TEST_F(SqliteBagTest, OfAPageThatWasCutNothingIsGuessed) {
  WriteSqliteBag(path_, RoomBag(50));
  CutFile(path_, 0.7, folder_.File("whole"), 4096);
  const auto whole = ReadFile(folder_.File("whole"), 1 << 26);
  ASSERT_TRUE(WriteFile(folder_.File("cut"), *whole + "more").ok());
  EXPECT_THAT(OpenSqliteBag(folder_.File("cut"), kWanted).status().message(),
              HasSubstr(absl::StrCat("cut to ", whole->size(), " bytes")));
}

TEST_F(SqliteBagTest, DatabaseOfSomethingElseIsRefused) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path_.c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database, "CREATE TABLE a(b)", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  EXPECT_TRUE(IsSqlite(path_));
  EXPECT_THAT(OpenSqliteBag(path_, kWanted).status().message(),
              HasSubstr("no bag of rosbag2: no such table: topics"));
}

}  // namespace sqlite_bag_test
}  // namespace plumescout::lab
