// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_loop_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace plumescout::client {
namespace robot_loop_options_test {

TEST(RobotLoopOptionsTest, NonsenseIsRefusedByName) {
  RobotLoopOptions options;
  EXPECT_TRUE(Validate(options).ok());

  options.tick_s = 0.0;
  EXPECT_THAT(std::string(Validate(options).message()), ::testing::HasSubstr("tick_s"));
  options = {};
  options.answer_look_s = 0.0;
  EXPECT_THAT(std::string(Validate(options).message()), ::testing::HasSubstr("answer_look_s"));
  options = {};
  options.replan_period_s = -1.0;
  EXPECT_THAT(std::string(Validate(options).message()), ::testing::HasSubstr("replan_period_s"));
  options = {};
  options.rates.gas_hz = std::nan("");
  EXPECT_THAT(std::string(Validate(options).message()), ::testing::HasSubstr("gas_hz"));
  options = {};
  options.new_log_epoch = kLogEpochEnd;
  EXPECT_THAT(std::string(Validate(options).message()), ::testing::HasSubstr("new_log_epoch"));
  options = {};
  options.ingest.store.folder = "somewhere";  // needs an epoch
  EXPECT_THAT(std::string(Validate(options).message()), ::testing::HasSubstr("new_log_epoch"));
}

}  // namespace robot_loop_options_test
}  // namespace plumescout::client
