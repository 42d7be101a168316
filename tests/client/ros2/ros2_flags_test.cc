// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/ros2_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <string>
#include <vector>

namespace plumescout::client {
namespace ros2_flags_test {

class Ros2FlagsTest : public ::testing::Test {
 protected:
  void Parse(std::vector<std::string> arguments) {
    CLI::App app("", "test");
    AddListenFlags(app, listen_);
    AddTellFlags(app, tell_);
    std::reverse(arguments.begin(), arguments.end());  // as CLI wants them
    app.parse(arguments);
  }

  ListenFlags listen_;
  TellFlags tell_;
};

TEST_F(Ros2FlagsTest, WhatIsToldLiesWhereItIsListened) {
  Parse({"--domain", "7", "--namespace", "robot1", "--map-frame", "world", "--gas-calibration",
         "2,1.5", "--drive-by", "goal", "--map-topic", ""});
  ASSERT_TRUE(Prepare(listen_).ok());
  Prepare(listen_, {.mission_from_robot = {1.0, 2.0, 0.0}}, tell_);
  EXPECT_EQ(listen_.domain, 7);
  EXPECT_EQ(listen_.intake.gas_calibration->exponent, 1.5);
  EXPECT_EQ(tell_.plan.drives, Drives::kGoal);
  EXPECT_EQ(tell_.plan.topics.ros_namespace, "robot1");
  EXPECT_EQ(tell_.plan.map_frame, "world");
  EXPECT_EQ(tell_.plan.frame.mission_from_robot.x_m, 1.0);
  EXPECT_EQ(tell_.map.topics.ros_namespace, "robot1");
  EXPECT_EQ(tell_.map.topics.map, "");
  EXPECT_EQ(tell_.map.map_frame, "world");
}

TEST_F(Ros2FlagsTest, WhatIsWrongIsRefused) {
  EXPECT_THROW(Parse({"--domain", "300"}), CLI::ParseError);
  EXPECT_THROW(Parse({"--drive-by", "magic"}), CLI::ParseError);
  Parse({"--gas-calibration", "steep"});
  EXPECT_THAT(Prepare(listen_).message(), ::testing::HasSubstr("steep"));
}

}  // namespace ros2_flags_test
}  // namespace plumescout::client
