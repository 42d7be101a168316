// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <utility>

namespace plumescout::client {
namespace robot_flags_test {

RobotFlags Parse(const std::string& line) {
  CLI::App app("", "test");
  RobotFlags flags;
  AddRobotFlags(app, flags);
  app.parse("--mission hall --robot r1 " + line);
  return flags;
}

TEST(RobotFlagsTest, BecomeOptionsOfTheLoop) {
  RobotFlags flags = Parse(
      "--create-mission --frame-x 2 --gas-sensor pid,0.2 --max-speed 0.5 --replan-period 1.5");
  ASSERT_TRUE(Prepare(flags).ok());
  const RobotLoopOptions& loop = flags.loop;
  EXPECT_EQ(loop.participation.mission, "hall");
  EXPECT_EQ(loop.participation.frame.mission_from_robot.x_m, 2.0);
  EXPECT_TRUE(loop.participation.create.has_value());
  EXPECT_EQ(loop.participation.sensors.size(), 1u);
  EXPECT_EQ(loop.follower.max_forward_mps, 0.5);
  EXPECT_EQ(loop.replan_period_s, 1.5);
  EXPECT_GT(loop.new_log_epoch, 0);
  EXPECT_TRUE(loop.real_clock);
  EXPECT_TRUE(Validate(loop).ok()) << Validate(loop);
}

TEST(RobotFlagsTest, TheRunIsRecordedWhereTheySay) {
  EXPECT_EQ(Parse("").record_folder, "") << "and not by themselves";
  const RobotRecordingOptions options = RecordingOf(Parse("--record /srv/runs"), "plumescout-test");
  EXPECT_EQ(options.folder, "/srv/runs");
  testing::internal::CaptureStderr();
  options.say("recorded");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "plumescout-test: recorded\n");
}

TEST(RobotFlagsTest, WhatIsWrongIsQuoted) {
  RobotFlags flags = Parse("--gas-sensor pid,ahead");
  EXPECT_THAT(Prepare(flags).message(), ::testing::HasSubstr("pid,ahead"));
  flags = Parse("--token-file /nowhere/token");
  EXPECT_FALSE(Prepare(flags).ok());
}

}  // namespace robot_flags_test
}  // namespace plumescout::client
