// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/sensor_arguments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumescout::client {
namespace sensor_arguments_test {

TEST(SensorArgumentsTest, WhatIsLeftOutIsNone) {
  const auto sensors = ReadSensors({"pid,0.2,-0.1,0.5,2", "mox"});
  ASSERT_TRUE(sensors.ok()) << sensors.status();
  EXPECT_THAT(*sensors, ::testing::ElementsAre(GasSensor{"pid", {0.2, -0.1}, 0.5, 2.0},
                                               GasSensor{"mox", {}, 0.0, 0.0}));
  EXPECT_TRUE(ReadSensors({})->empty());
}

TEST(SensorArgumentsTest, TheLastPartsAreTheGasAndTheResponseTime) {
  const auto sensors = ReadSensors({"ec,0,0,0,0,hydrogen-sulfide"});
  ASSERT_TRUE(sensors.ok()) << sensors.status();
  EXPECT_THAT(*sensors, ::testing::ElementsAre(GasSensor{"ec", {}, 0.0, 0.0, "hydrogen-sulfide"}));
  const auto slow = ReadSensors({"ec,0,0,0,0,,30"});
  ASSERT_TRUE(slow.ok()) << slow.status();
  EXPECT_THAT(*slow, ::testing::ElementsAre(GasSensor{"ec", {}, 0.0, 0.0, "", 30.0}));
}

TEST(SensorArgumentsTest, OthersAreQuoted) {
  for (const char* text :
       {"pid,ahead", "pid,1,2,3,4,methane,slow", "pid,1,2,3,4,methane,6,7", "pid,"}) {
    const auto refused = ReadSensors({text});
    EXPECT_TRUE(absl::IsInvalidArgument(refused.status()));
    EXPECT_THAT(refused.status().message(), ::testing::HasSubstr(text));
  }
}

}  // namespace sensor_arguments_test
}  // namespace plumescout::client
