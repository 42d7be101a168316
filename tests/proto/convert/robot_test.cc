// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/robot.h"

#include <gtest/gtest.h>

#include <vector>

namespace plumescout {
namespace robot_test {

TEST(RobotTest, SensorsComeBackAsTheyWere) {
  const std::vector<GasSensor> sensors = {{"pid", {0.1, -0.2}, 0.5, 1.5},
                                          {"mox", {}, 0.0, 0.0, "methane", 4.0}};
  v1::RegisterRobotRequest request;
  ToProto(sensors, request);
  EXPECT_EQ(request.gas_sensors(0).offset_stddev_ppm(), 1.5);
  EXPECT_EQ(request.gas_sensors(1).species(), "methane");
  EXPECT_EQ(request.gas_sensors(1).response_time_s(), 4.0);
  EXPECT_EQ(SensorsFromProto(request), sensors);
  EXPECT_TRUE(SensorsFromProto(v1::RegisterRobotRequest()).empty());
}

}  // namespace robot_test
}  // namespace plumescout
