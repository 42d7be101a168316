// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/sensor_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace plumescout {
namespace sensor_check_test {

// What is said of two sensors of which the second is broken.
std::string Refusal(void (*spoil)(GasSensor&)) {
  std::vector<GasSensor> sensors = {{"pid", {0.1, -0.2}, 0.5, 1.0}, {"mox", {}, 0.0, 0.0}};
  EXPECT_TRUE(CheckSensors(sensors).ok());
  spoil(sensors[1]);
  const absl::Status status = CheckSensors(sensors);
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  return std::string(status.message());
}

TEST(SensorCheckTest, NamesFieldAndValue) {
  EXPECT_THAT(Refusal([](GasSensor& s) { s.id = ""; }), ::testing::HasSubstr("gas_sensors[1].id"));
  EXPECT_THAT(Refusal([](GasSensor& s) { s.id = "pid"; }),
              ::testing::HasSubstr("\"pid\" is that of another"));
  EXPECT_THAT(Refusal([](GasSensor& s) { s.robot_from_sensor.x_m = 11.0; }),
              ::testing::HasSubstr("gas_sensors[1].robot_from_sensor.x_m = 11"));
  EXPECT_THAT(Refusal([](GasSensor& s) { s.robot_from_sensor.y_m = NAN; }),
              ::testing::HasSubstr("robot_from_sensor.y_m"));
  EXPECT_THAT(Refusal([](GasSensor& s) { s.stddev_ppm = -1.0; }),
              ::testing::HasSubstr("gas_sensors[1].stddev_ppm = -1"));
  EXPECT_THAT(Refusal([](GasSensor& s) { s.response_time_s = 3601.0; }),
              ::testing::HasSubstr("gas_sensors[1].response_time_s = 3601"));
  EXPECT_THAT(Refusal([](GasSensor& s) { s.offset_stddev_ppm = s.response_time_s = 1.5; }),
              ::testing::HasSubstr("gas_sensors[1].offset_stddev_ppm = 1.5 must be 0"));
  EXPECT_THAT(Refusal([](GasSensor& s) { s.offset_stddev_ppm = 2e6; }),
              ::testing::HasSubstr("gas_sensors[1].offset_stddev_ppm = 2e+06"));
}

TEST(SensorCheckTest, TakesSixteen) {
  std::vector<GasSensor> sensors;
  for (std::size_t i = 0; i < kMostSensors; ++i) {
    sensors.push_back({"s" + std::to_string(i), {}, 0.0, 0.0});
  }
  EXPECT_TRUE(CheckSensors(sensors).ok());
  sensors.push_back({"more", {}, 0.0, 0.0});
  EXPECT_THAT(CheckSensors(sensors).message(), ::testing::HasSubstr("17 sensors"));
}

TEST(SensorCheckTest, OffsetsAreForReadingsThatDoNotAge) {
  GasOptions gas;
  const std::vector<GasSensor> sensors = {{"pid", {}, 0.0, 1.0}};
  EXPECT_TRUE(CheckOffsets(sensors, gas).ok());
  gas.ageing_half_life_s = 120.0;
  EXPECT_TRUE(CheckOffsets({}, gas).ok());
  const absl::Status status = CheckOffsets(sensors, gas);
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_THAT(status.message(), ::testing::HasSubstr("offset_stddev_ppm = 1"));
}

TEST(SensorCheckTest, OffsetsAreForFieldsOfConcentrations) {
  GasOptions gas;
  gas.scale = GasScale::kSquareRoot;
  EXPECT_TRUE(CheckOffsets({{"pid", {}, 0.0, 0.0}}, gas).ok());
  const absl::Status status = CheckOffsets({{"pid", {}, 0.0, 1.0}}, gas);
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_THAT(status.message(), ::testing::HasSubstr("offset_stddev_ppm = 1 must be 0"));
}

TEST(SensorCheckTest, SensorsReadWhatTheMissionMaps) {
  MissionOptions options;
  std::vector<GasSensor> sensors = {{"pid", {}, 0.0, 0.0}};
  EXPECT_TRUE(CheckSpecies(sensors, options).ok());
  sensors[0].species = "methane";
  EXPECT_THAT(CheckSpecies(sensors, options).message(),
              ::testing::HasSubstr("gas_sensors[0].species = \"methane\" must be empty: the "
                                   "mission names no gas"));
  options.gas_species.resize(1);
  options.gas_species[0].name = "methane";
  EXPECT_TRUE(CheckSpecies(sensors, options).ok());
  sensors[0].species = "Methane";
  const absl::Status status = CheckSpecies(sensors, options);
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_THAT(status.message(), ::testing::HasSubstr("must be empty or one of \"methane\""));
}

}  // namespace sensor_check_test
}  // namespace plumescout
