// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/gas_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace gas_sensor_test {

GasSensorOptions Noiseless() {
  GasSensorOptions options;
  options.noise_sigma_ppm = 0.0;
  options.noise_share = 0.0;
  return options;
}

TEST(GasSensorTest, AnswersAStepWithTheExponential) {
  for (const double step_s : {0.5, 0.05, 0.013}) {  // however finely it is stepped
    GasSensor sensor(Noiseless(), 1);
    for (int i = 1; i <= 40; ++i) {
      sensor.Step(100.0, step_s);
      // tau = 0.5 s; rounding of 40 multiplications
      EXPECT_NEAR(sensor.Read_ppm(), 100.0 * (1.0 - std::exp(-i * step_s / 0.5)), 1e-11);
    }
  }
}

TEST(GasSensorTest, FallsAsItRose) {
  GasSensor sensor(Noiseless(), 1);
  sensor.Step(100.0, 60.0);
  sensor.Step(0.0, 0.5);
  EXPECT_NEAR(sensor.Read_ppm(), 100.0 * std::exp(-1.0), 1e-9);
}

TEST(GasSensorTest, FollowsAtOnceWithoutALag) {
  GasSensorOptions options = Noiseless();
  options.time_constant_s = 0.0;
  GasSensor sensor(options, 1);
  sensor.Step(42.0, 0.001);
  EXPECT_EQ(sensor.Read_ppm(), 42.0);
}

TEST(GasSensorTest, HasNoiseOfBothKinds) {
  GasSensor sensor({}, 5);
  sensor.Step(50.0, 3600.0);
  const double sigma = std::sqrt(0.1 * 0.1 + 0.5 * 0.5);  // 0.1 ppm and 1 % of 50 ppm
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kReadings = 4000;
  for (int i = 0; i < kReadings; ++i) {
    const double error = (sensor.Read_ppm() - 50.0) / sigma;
    sum += error;
    squares += error * error;
  }
  // Standard normal sums, to 4 standard deviations.
  EXPECT_NEAR(sum, 0.0, 4.0 * std::sqrt(kReadings));
  EXPECT_NEAR(squares, kReadings, 4.0 * std::sqrt(2.0 * kReadings));
}

TEST(GasSensorTest, ReadsNothingOrAtLeastTheDetectionLimit) {
  GasSensor sensor({}, 5);
  int nothing = 0;
  int something = 0;
  for (int i = 0; i < 1000; ++i) {
    const double reading = sensor.Read_ppm();  // clean air: noise alone
    EXPECT_TRUE(reading == 0.0 || reading >= 0.05) << reading;
    ++(reading == 0.0 ? nothing : something);
  }
  EXPECT_GT(nothing, 0);
  EXPECT_GT(something, 0);
}

TEST(GasSensorTest, IsNeverNegativeWithoutADetectionLimit) {
  GasSensorOptions options;
  options.detection_limit_ppm = 0.0;
  GasSensor sensor(options, 5);
  for (int i = 0; i < 1000; ++i) EXPECT_GE(sensor.Read_ppm(), 0.0);
}

TEST(GasSensorTest, RejectsOptionsOutOfRange) {
  EXPECT_TRUE(Validate(GasSensorOptions{}).ok());
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    GasSensorOptions options;
    options.time_constant_s = bad;
    EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
    options = {};
    options.noise_sigma_ppm = bad;
    EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
    options = {};
    options.noise_share = bad;
    EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
    options = {};
    options.detection_limit_ppm = bad;
    EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument);
  }
}

TEST(GasSensorTest, ReadsNoMoreThanItsSaturation) {
  GasSensorOptions options = Noiseless();
  options.saturation_ppm = 200.0;
  GasSensor sensor(options, 1);
  sensor.Step(5000.0, 60.0);
  EXPECT_EQ(sensor.Read_ppm(), 200.0);
  sensor.Step(150.0, 60.0);
  EXPECT_NEAR(sensor.Read_ppm(), 150.0, 1e-9) << "the cell itself was not overfilled for good";
}

TEST(GasSensorTest, ReadsWholeMultiplesOfItsResolution) {
  GasSensor sensor(CarbonDioxideCell(), 3, 437.0);
  bool varies = false;
  double first = -1.0;
  for (int i = 0; i < 200; ++i) {
    const double reading = sensor.Read_ppm();
    EXPECT_EQ(std::fmod(reading, 10.0), 0.0) << reading;
    if (first < 0.0) first = reading;
    varies = varies || reading != first;
  }
  EXPECT_TRUE(varies);
}

TEST(GasSensorTest, StartsAtRestInTheAirThereIs) {
  GasSensor sensor(Noiseless(), 1, 400.0);
  EXPECT_EQ(sensor.Read_ppm(), 400.0);
}

TEST(GasSensorTest, TheCarbonDioxideCellIsSlow) {
  GasSensorOptions options = CarbonDioxideCell();
  options.noise_sigma_ppm = options.noise_share = options.resolution_ppm = 0.0;
  GasSensor sensor(options, 1, 400.0);
  sensor.Step(1400.0, 5.0);
  EXPECT_NEAR(sensor.Read_ppm(), 1400.0 - 1000.0 * std::exp(-5.0 / 4.0), 1e-9);
}

TEST(GasSensorTest, PresetsAreValid) {
  EXPECT_TRUE(Validate(PhotoIonisationDetector()).ok());
  EXPECT_TRUE(Validate(CarbonDioxideCell()).ok());
}

TEST(GasSensorTest, RejectsLimitsThatMakeNoSense) {
  for (const double bad :
       {-1.0, 0.01, std::nan(""), HUGE_VAL}) {  // 0.01: the detection limit is more
    GasSensorOptions options;
    options.saturation_ppm = bad;
    EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument) << bad;
  }
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) {
    GasSensorOptions options;
    options.resolution_ppm = bad;
    EXPECT_EQ(Validate(options).code(), absl::StatusCode::kInvalidArgument) << bad;
  }
}

}  // namespace gas_sensor_test
}  // namespace plumescout::lab
