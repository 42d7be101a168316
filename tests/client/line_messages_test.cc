// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/line_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::client {
namespace line_messages_test {

TEST(ParseRobotLine, ReadsAPose) {
  const auto line =
      ParseRobotLine(R"({"type":"pose","time_ns":17,"x_m":1.5,"y_m":-2,"yaw_rad":0.5})");

  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_EQ(line->time_ns, 17);
  EXPECT_EQ(line->pose, (Pose2{1.5, -2.0, 0.5}));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(line->reading));
}

TEST(ParseRobotLine, WrapsTheHeading) {
  const auto line = ParseRobotLine(R"({"type":"pose","time_ns":1,"x_m":0,"y_m":0,"yaw_rad":7})");

  EXPECT_NEAR(line->pose->yaw_rad, 7.0 - 2.0 * M_PI, 1e-12);
}

TEST(ParseRobotLine, ReadsAScanWithSilentAndEmptyBeams) {
  const auto line = ParseRobotLine(
      R"({"type":"scan","time_ns":9,"start_angle_rad":-1,"angle_step_rad":0.5,"max_range_m":8,)"
      R"("ranges_m":[1.5,null,8,9.5]})");

  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_FALSE(line->pose.has_value());
  const auto& scan = std::get<Scan>(line->reading);
  EXPECT_EQ(scan.start_angle_rad, -1.0);
  EXPECT_EQ(scan.angle_step_rad, 0.5);
  EXPECT_EQ(scan.max_range_m, 8.0);
  ASSERT_EQ(scan.ranges_m.size(), 4U);
  EXPECT_EQ(scan.ranges_m[0], 1.5F);
  EXPECT_TRUE(std::isnan(scan.ranges_m[1]));
  EXPECT_TRUE(std::isinf(scan.ranges_m[2]));
  EXPECT_TRUE(std::isinf(scan.ranges_m[3]));
}

TEST(ParseRobotLine, ReadsGasWithItsOwnPoseAndDeviation) {
  const auto line =
      ParseRobotLine(R"({"type":"gas","time_ns":9,"concentration_ppm":3,"stddev_ppm":0.5,)"
                     R"("pose":{"x_m":1,"y_m":2,"yaw_rad":3}})");

  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_EQ(line->pose, (Pose2{1, 2, 3}));
  EXPECT_EQ(std::get<GasReading>(line->reading), (GasReading{3.0, 0.25}));
}

TEST(ParseRobotLine, ReadsStatus) {
  const auto line = ParseRobotLine(R"({"type":"status","time_ns":9,"battery_share":0.25})");

  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_EQ(std::get<RobotStatus>(line->reading), RobotStatus{0.25});
}

TEST(ParseRobotLine, RefusesWhatItCannotUseAndNamesIt) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "JSON"},
      {"nonsense", "JSON"},
      {"[1,2]", "JSON"},
      {R"({"time_ns":1})", "type"},
      {R"({"type":7,"time_ns":1})", "type"},
      {R"({"type":"sonar","time_ns":1})", "sonar"},
      {R"({"type":"gas","concentration_ppm":1})", "time_ns"},
      {R"({"type":"gas","time_ns":1.5,"concentration_ppm":1})", "time_ns"},
      {R"({"type":"gas","time_ns":1,"concentration_ppm":"high"})", "concentration_ppm"},
      {R"({"type":"gas","time_ns":1,"concentration_ppm":1e999})", "JSON"},
      {R"({"type":"pose","time_ns":1,"x_m":0,"y_m":0})", "yaw_rad"},
      {R"({"type":"gas","time_ns":1,"concentration_ppm":1,"pose":{"x_m":1}})", "y_m"},
      {R"({"type":"gas","time_ns":1,"concentration_ppm":1,"pose":5})", "x_m"},
      {R"({"type":"status","time_ns":1})", "battery_share"},
      {R"({"type":"status","time_ns":1,"battery_share":2})", "battery_share = 2"},
      {R"({"type":"status","time_ns":1,"battery_share":null})", "battery_share"},
      {R"({"type":"scan","time_ns":1,"start_angle_rad":0,"angle_step_rad":1,"max_range_m":8,)"
       R"("ranges_m":["far"]})",
       "ranges_m"},
      {R"({"type":"scan","time_ns":1,"start_angle_rad":0,"angle_step_rad":1,"max_range_m":8})",
       "ranges_m"},
  };
  for (const auto& [text, word] : cases) {
    const auto line = ParseRobotLine(text);
    EXPECT_TRUE(absl::IsInvalidArgument(line.status())) << text;
    EXPECT_THAT(std::string(line.status().message()), ::testing::HasSubstr(word)) << text;
  }
}

TEST(FormatTwistLine, IsOneLineOfJson) {
  EXPECT_EQ(FormatTwistLine({.forward_mps = 0.25, .turn_rad_per_s = -0.5}),
            "{\"forward_mps\":0.25,\"turn_rad_per_s\":-0.5,\"type\":\"twist\"}\n");
}

TEST(ParseRobotLine, ReadsACorrection) {
  const auto line = ParseRobotLine(
      R"({"type":"correction","time_ns":9,"pose":{"x_m":1,"y_m":2,"yaw_rad":0},"anchors":)"
      R"([{"time_ns":3,"x_m":0.5,"y_m":0,"yaw_rad":0},{"time_ns":7,"x_m":1,"y_m":2,"yaw_rad":1}]})");

  ASSERT_TRUE(line.ok()) << line.status();
  EXPECT_EQ(line->pose, (Pose2{1.0, 2.0, 0.0}));
  EXPECT_EQ(std::get<PoseCorrection>(line->reading),
            (PoseCorrection{{{3, {0.5, 0.0, 0.0}}, {7, {1.0, 2.0, 1.0}}}}));
  EXPECT_FALSE(ParseRobotLine(R"({"type":"correction","time_ns":9,"anchors":[]})").ok());
  EXPECT_FALSE(ParseRobotLine(R"({"type":"correction","time_ns":9,"anchors":[3]})").ok());
  EXPECT_FALSE(ParseRobotLine(R"({"type":"correction","time_ns":9})").ok());
}

}  // namespace line_messages_test
}  // namespace plumescout::client
