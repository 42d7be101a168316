// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/input_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/client/ros2/loopback_dds.h"
#include "tests/client/ros2/stamped.h"

namespace plumescout::client {
namespace input_watch_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void PublishPose(RobotIntake& intake, std::int64_t time_ns) {
  intake.OnTransforms({.transforms = {Stamped("map", "odom", time_ns, {}),
                                      Stamped("odom", "base_link", time_ns, {})}},
                      false);
}

TEST(InputWatch, NamesWhatHasNotComeSinceItBegan) {
  KeepDdsToLoopback();
  const auto node = DdsNode::Open(OwnDomain());
  ASSERT_TRUE(node.ok()) << node.status();
  RobotIntake intake{IntakeOptions{}};
  const TopicNames names{.scan = "", .odometry = "", .tf_static = "", .wind = ""};
  ASSERT_TRUE(ListenToRobot(names, **node, intake).ok());
  InputWatch watch(names, intake, **node);
  EXPECT_THAT(watch.Missing(),
              ElementsAre(HasSubstr("no transform map → base_link yet"), HasSubstr("no gas"),
                          "nobody publishes /tf", "nobody publishes /PID/Sensor_reading"));

  PublishPose(intake, 1'000'000'000);
  ros::GasSensor gas;
  gas.header = {.stamp = ros::ToTime(1'000'000'000), .frame_id = "base_link"};
  gas.raw_units = ros::GasSensor::kPpm;
  intake.OnGas(gas, 0);
  ASSERT_TRUE(intake.TakeGas(0).has_value());
  EXPECT_THAT(watch.Missing(), IsEmpty());

  watch.Begin();
  EXPECT_THAT(watch.Missing(),
              ElementsAre("no news of the robot's place", HasSubstr("no gas"),
                          "nobody publishes /tf", "nobody publishes /PID/Sensor_reading"));
}

}  // namespace input_watch_test
}  // namespace plumescout::client
