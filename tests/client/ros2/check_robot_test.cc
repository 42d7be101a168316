// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/check_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/client/ros2/box_robot.h"

namespace plumescout::client {
namespace check_robot_test {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kPatience_s = 60.0;  // far beyond what it takes anywhere

class CheckRobotTest : public ::testing::Test {
 protected:
  CheckRobotTest() {
    KeepDdsToLoopback();
    flags_.domain = OwnDomain();
    flags_.topics.ros_namespace = "robot1";
  }
  absl::StatusOr<bool> Check(double seconds) {
    return CheckRobot(flags_, seconds, [this](const std::string& text) { said_.push_back(text); });
  }

  ListenFlags flags_;
  std::vector<std::string> said_;
};

TEST_F(CheckRobotTest, EndsAsSoonAsAllHasCome) {
  const BoxRobot robot;
  const auto complete = Check(kPatience_s);
  ASSERT_TRUE(complete.ok()) << complete.status();
  EXPECT_TRUE(*complete);
}

TEST_F(CheckRobotTest, SaysWhatIsMissing) {
  const auto complete = Check(0.2);
  ASSERT_TRUE(complete.ok()) << complete.status();
  EXPECT_FALSE(*complete);
  EXPECT_THAT(said_, Contains(HasSubstr("missing: nobody publishes /robot1/scan")));
  EXPECT_THAT(said_, Contains(HasSubstr("heard 0 scans")));
  flags_.gas_calibration = "steep";
  EXPECT_FALSE(Check(0.2).ok());
}

TEST_F(CheckRobotTest, WhatIsNotListenedToIsNotMissed) {
  const BoxRobot robot(BoxRobotOptions{.publishes_gas = false});
  flags_.topics.gas = "";
  const auto complete = Check(kPatience_s);
  ASSERT_TRUE(complete.ok()) << complete.status();
  EXPECT_TRUE(*complete);
}

}  // namespace check_robot_test
}  // namespace plumescout::client
