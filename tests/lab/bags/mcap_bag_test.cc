// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bags/mcap_bag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lab/bags/bag_files.h"
#include "tests/support/temp_folder.h"

namespace plumescout::lab {
namespace mcap_bag_test {

using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::set<std::string> kWanted = {"/scan", "/PID/Sensor_reading"};

class McapBagTest : public ::testing::Test {
 protected:
  BagReading Read(const std::string& path, const std::set<std::string>& wanted) {
    auto bag = OpenMcapBag(path, wanted);
    EXPECT_TRUE(bag.ok()) << bag.status();
    if (!bag.ok()) return {};
    bag_ = *std::move(bag);
    return ReadAll(*bag_);
  }

  TempFolder folder_;
  const std::string path_ = folder_.File("bag");
  std::unique_ptr<BagReader> bag_;
};

TEST_F(McapBagTest, MessagesOfWantedTopicsComeInOrder) {
  const std::vector<BagMessage> all = RoomBag(20);
  WriteMcapBag(path_, all);
  const BagReading reading = Read(path_, {"/tf", "/tf_static", "/scan", "/PID/Sensor_reading"});
  EXPECT_TRUE(reading.end.ok()) << reading.end;
  EXPECT_EQ(reading.torn_end, "");
  EXPECT_EQ(reading.messages, all);
  EXPECT_EQ(bag_->share_read(), 1.0);
  EXPECT_THAT(Read(path_, kWanted).messages, SizeIs(40));
  EXPECT_EQ(bag_->topics().at("/tf"), "tf2_msgs/msg/TFMessage");
}

TEST_F(McapBagTest, WhatIsNoCdrIsCountedAndPassedOver) {
  WriteMcapBag(path_, RoomBag(3), {{"/scan", "json"}});
  EXPECT_THAT(Read(path_, kWanted).messages, SizeIs(3));
  EXPECT_EQ(bag_->unknown_encodings().at("json"), 3);
}

TEST_F(McapBagTest, OfAFileThatWasCutOffTheFrontIsRead) {
  const std::vector<BagMessage> all = RoomBag(200);
  WriteMcapBag(path_, all);
  CutFile(path_, 0.7, folder_.File("cut"));
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

}  // namespace mcap_bag_test
}  // namespace plumescout::lab
