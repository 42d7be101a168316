// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/sensor_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout::client {
namespace sensor_conversion_test {

using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

ros::LaserScan SomeScan() {
  ros::LaserScan scan;
  scan.angle_min = -1.0F;
  scan.angle_increment = 0.5F;
  scan.range_min = 0.1F;
  scan.range_max = 8.0F;
  scan.ranges = {1.0F, kNan, kInf, 9.0F, 0.05F, -1.0F, 8.0F};
  return scan;
}

TEST(ToScan, KnowsUnknownFromNothing) {
  const auto scan = ToScan(SomeScan(), false);
  ASSERT_TRUE(scan.ok()) << scan.status();
  EXPECT_EQ(scan->start_angle_rad, -1.0);
  EXPECT_EQ(scan->angle_step_rad, 0.5);
  const std::vector<float>& ranges_m = scan->ranges_m;
  ASSERT_EQ(ranges_m.size(), 7u);
  EXPECT_EQ(ranges_m[0], 1.0F);
  EXPECT_TRUE(std::isnan(ranges_m[1]));
  EXPECT_EQ(ranges_m[2], kInf);
  EXPECT_EQ(ranges_m[3], kInf);
  EXPECT_TRUE(std::isnan(ranges_m[4]));
  EXPECT_TRUE(std::isnan(ranges_m[5]));
  EXPECT_EQ(ranges_m[6], 8.0F);
}

// The beam at -1 rad of a sensor that hangs upside down points to 1 rad.
TEST(ToScan, TurnsWhatHangsUpsideDown) {
  const auto scan = ToScan(SomeScan(), true);
  ASSERT_TRUE(scan.ok()) << scan.status();
  EXPECT_NEAR(scan->start_angle_rad, -2.0, 1e-12);
  EXPECT_EQ(scan->angle_step_rad, 0.5);
  EXPECT_EQ(scan->ranges_m.front(), 8.0F);
  EXPECT_EQ(scan->ranges_m.back(), 1.0F);
}

TEST(ToScan, CountsClockwiseScansTheOtherWay) {
  ros::LaserScan message = SomeScan();
  message.angle_min = 1.0F;
  message.angle_increment = -0.5F;
  const auto scan = ToScan(message, false);
  ASSERT_TRUE(scan.ok()) << scan.status();
  EXPECT_NEAR(scan->start_angle_rad, -2.0, 1e-12);
  EXPECT_EQ(scan->angle_step_rad, 0.5);
  EXPECT_EQ(scan->ranges_m.back(), 1.0F);
}

TEST(ToScan, NamesTheFieldThatMakesNoSense) {
  ros::LaserScan message = SomeScan();
  message.angle_increment = 0.0F;
  EXPECT_THAT(ToScan(message, false).status().message(), HasSubstr("angle_increment is 0"));
  message = SomeScan();
  message.angle_min = kNan;
  EXPECT_THAT(ToScan(message, false).status().message(), HasSubstr("angle_min is nan"));
  message = SomeScan();
  message.range_max = kInf;
  EXPECT_THAT(ToScan(message, false).status().message(), HasSubstr("range_max is inf"));
  message = SomeScan();
  message.ranges.clear();
  EXPECT_THAT(ToScan(message, false).status().message(), HasSubstr("number of ranges is 0"));
}

ros::GasSensor Gas(double raw, int unit) {
  ros::GasSensor gas;
  gas.raw = raw;
  gas.raw_units = static_cast<std::uint8_t>(unit);
  return gas;
}

TEST(ToGasReading, KnowsConcentrations) {
  EXPECT_EQ(ToGasReading(Gas(3.5, ros::GasSensor::kPpm), {})->concentration_ppm, 3.5);
  EXPECT_EQ(ToGasReading(Gas(3500.0, ros::GasSensor::kPpb), {})->concentration_ppm, 3.5);
  EXPECT_EQ(ToGasReading(Gas(-0.1, ros::GasSensor::kPpm), {})->concentration_ppm, 0.0);
}

TEST(ToGasReading, TakesOhmAndVoltByCalibrationOnly) {
  EXPECT_THAT(ToGasReading(Gas(2.0, ros::GasSensor::kOhm), {}).status().message(),
              HasSubstr("raw_units is OHM"));
  const GasCalibration calibration{.scale_ppm = 12.0, .exponent = -2.0};
  EXPECT_EQ(ToGasReading(Gas(2.0, ros::GasSensor::kOhm), calibration)->concentration_ppm, 3.0);
  EXPECT_EQ(ToGasReading(Gas(2.0, ros::GasSensor::kVolt), calibration)->concentration_ppm, 3.0);
  EXPECT_THAT(ToGasReading(Gas(2.0, 100), calibration).status().message(),
              HasSubstr("raw_units is CENTIGRADE"));
  EXPECT_FALSE(ToGasReading(Gas(0.0, ros::GasSensor::kOhm), calibration).ok());  // infinite
}

TEST(ToGasReading, RefusesWhatIsNoNumber) {
  EXPECT_THAT(ToGasReading(Gas(std::nan(""), ros::GasSensor::kPpm), {}).status().message(),
              HasSubstr("raw is nan"));
}

TEST(ReadCalibration, QuotesWhatIsNone) {
  EXPECT_EQ(ReadCalibration("12,-1.5")->exponent, -1.5);
  for (const char* text : {"", "1", "0,1", "a,1", "1,2,3", "inf,1"}) {
    EXPECT_THAT(ReadCalibration(text).status().message(), HasSubstr(text)) << text;
    EXPECT_FALSE(ReadCalibration(text).ok()) << text;
  }
}

TEST(CheckWind, NamesWhatIsNoWind) {
  ros::Anemometer wind;
  wind.wind_speed = 1.0F;
  EXPECT_TRUE(CheckWind(wind).ok());
  wind.wind_direction = kNan;
  EXPECT_THAT(CheckWind(wind).message(), HasSubstr("wind_direction is nan"));
  wind.wind_speed = -1.0F;
  EXPECT_THAT(CheckWind(wind).message(), HasSubstr("wind_speed is -1"));
}

}  // namespace sensor_conversion_test
}  // namespace plumescout::client
