// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/robot_topics.h"

#include <gtest/gtest.h>

#include "absl/time/clock.h"
#include "tests/client/ros2/loopback_dds.h"
#include "tests/client/ros2/stamped.h"

namespace plumescout::client {
namespace robot_topics_test {

constexpr std::int64_t kTime_ns = 100'000'000'000;

// A robot in its namespace, whose scanner, gas sensor and transforms are heard and placed; what is
// no message of the topic's type is refused, and the next one counts.
TEST(ListenToRobot, HearsAWholeRobot) {
  KeepDdsToLoopback();
  const int domain = OwnDomain();
  RobotIntake intake{IntakeOptions{}};
  const auto node = DdsNode::Open(domain);
  ASSERT_TRUE(node.ok()) << node.status();
  ASSERT_TRUE(ListenToRobot({.ros_namespace = "robot1", .tf = "/tf"}, **node, intake).ok());

  const auto robot = DdsNode::Open(domain);
  ASSERT_TRUE(robot.ok()) << robot.status();
  const TopicQos latched{.delivery = Delivery::kLatched, .depth = 5};
  const auto tf_static = (*robot)->Advertise("/robot1/tf_static", ros::TfMessage::kType, latched);
  const auto tf = (*robot)->Advertise("/tf", ros::TfMessage::kType, latched);
  const auto scans = (*robot)->Advertise("/robot1/scan", ros::LaserScan::kType, latched);
  const auto gas =
      (*robot)->Advertise("/robot1/PID/Sensor_reading", ros::GasSensor::kType, latched);
  ASSERT_TRUE(tf_static.ok() && tf.ok() && scans.ok() && gas.ok());

  ros::LaserScan scan;
  scan.header = {.stamp = ros::ToTime(kTime_ns), .frame_id = "laser"};
  scan.angle_increment = 0.1F;
  scan.range_max = 8.0F;
  scan.ranges = {1.0F, 2.0F};
  ros::GasSensor reading;
  reading.header = {.stamp = ros::ToTime(kTime_ns), .frame_id = "base_link"};
  reading.raw = 4.0;
  reading.raw_units = ros::GasSensor::kPpm;
  const ros::TfMessage mounts{.transforms = {Stamped("base_link", "laser", 0, {0.2, 0.0, 0.0})}};
  const ros::TfMessage places{.transforms = {Stamped("map", "odom", kTime_ns, {1.0, 0.0, 0.0}),
                                             Stamped("odom", "base_link", kTime_ns, {})}};
  std::optional<PlacedSample<Scan>> heard;
  std::optional<PlacedSample<GasReading>> smelt;
  const absl::Time deadline = absl::Now() + absl::Seconds(60);
  while (!(heard && smelt && intake.counters().bad > 0) && absl::Now() < deadline) {
    // Best effort: what is published before anybody listens is lost.
    scan.header.stamp.nanosec += 1;
    reading.header.stamp.nanosec += 1;
    ASSERT_TRUE((*robot)->PublishBytes(*scans, "no scan at all").ok());
    ASSERT_TRUE((*robot)->Publish(*tf_static, mounts).ok());
    ros::TfMessage now = places;
    for (auto& transform : now.transforms) transform.header.stamp = scan.header.stamp;
    ASSERT_TRUE((*robot)->Publish(*tf, places).ok());
    ASSERT_TRUE((*robot)->Publish(*tf, now).ok());
    ASSERT_TRUE((*robot)->Publish(*scans, scan).ok());
    ASSERT_TRUE((*robot)->Publish(*gas, reading).ok());
    (*node)->Poll(absl::Milliseconds(50));
    if (!heard) heard = intake.TakeScan(0);
    if (!smelt) smelt = intake.TakeGas(0);
  }
  ASSERT_TRUE(heard.has_value());
  EXPECT_NEAR(heard->pose.x_m, 1.2, 1e-9);
  ASSERT_TRUE(smelt.has_value());
  EXPECT_NEAR(smelt->pose.x_m, 1.0, 1e-9);
  EXPECT_GT(intake.counters().bad, 0);
  EXPECT_TRUE(intake.LatestPose().ok());
}

}  // namespace robot_topics_test
}  // namespace plumescout::client
