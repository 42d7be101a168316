// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/dwell_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_scene.h"

namespace plumescout::lab {
namespace dwell_sensor_test {

constexpr Point2 kPlace{-0.05, 1.15};  // centre of cell (2, 1), index 7

// One cell's concentration steps from 10 to 30 ppm: frame 0 and 1 at 0 and 10 s, nearest counts.
SceneWorld SteppingWorld() {
  Scene scene = MakeSmallScene();
  scene.series.frames = 2;
  scene.series.dt_s = 10.0;
  scene.series.scale_ppm_per_count = 1.0;
  scene.series.counts.assign(2 * scene.geometry().size(), 0);
  scene.series.counts[7] = 10;
  scene.series.counts[scene.geometry().size() + 7] = 30;
  return SceneWorld(scene);
}

TEST(DwellSensorTest, ReadsTheMeanOverTheDwell) {
  const SceneWorld world = SteppingWorld();
  const DwellSensor sensor = MakeDwellSensor(world, {0.0, 0.0});
  Rng rng(1);
  EXPECT_DOUBLE_EQ(sensor({kPlace, 0.0, 4.0}, rng).concentration_ppm, 10.0);
  EXPECT_DOUBLE_EQ(sensor({kPlace, 6.0, 8.0}, rng).concentration_ppm, 30.0);
  EXPECT_DOUBLE_EQ(sensor({kPlace, 0.0, 10.0}, rng).concentration_ppm, 20.0);
}

TEST(DwellSensorTest, LeavesTheVarianceToTheMission) {
  const SceneWorld world = SteppingWorld();
  Rng rng(1);
  EXPECT_EQ(MakeDwellSensor(world, {})({kPlace, 0.0, 2.0}, rng).variance_ppm2, 0.0);
}

// Standard deviation of the mean of n values: sigma / sqrt(n); of their standard deviation:
// sigma / sqrt(2 n). Four of each.
TEST(DwellSensorTest, NoiseHasAConstantAndAProportionalPart) {
  const SceneWorld world = SteppingWorld();
  const DwellSensor sensor = MakeDwellSensor(world, {0.3, 0.04});
  const double sigma = std::hypot(0.3, 0.04 * 10.0);
  constexpr int kReadings = 4000;
  Rng rng(5);
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kReadings; ++i) {
    const double off = sensor({kPlace, 0.0, 2.0}, rng).concentration_ppm - 10.0;
    sum += off;
    squares += off * off;
  }
  EXPECT_NEAR(sum / kReadings, 0.0, 4.0 * sigma / std::sqrt(kReadings));
  EXPECT_NEAR(std::sqrt(squares / kReadings), sigma, 4.0 * sigma / std::sqrt(2.0 * kReadings));
}

// As above, with a variance of 0.4 ppm^2 at 10 ppm and three times as much at 30 ppm.
TEST(DwellSensorTest, VarianceMayBeProportionalToTheConcentration) {
  const SceneWorld world = SteppingWorld();
  const DwellSensor sensor = MakeDwellSensor(world, {0.0, 0.0, 0.04, 0.1});
  constexpr int kReadings = 4000;
  Rng rng(7);
  for (const double begin_s : {0.0, 6.0}) {
    const double true_ppm = begin_s > 0.0 ? 30.0 : 10.0;
    const double sigma = std::sqrt(0.04 * true_ppm);
    double squares = 0.0;
    for (int i = 0; i < kReadings; ++i) {
      const GasReading reading = sensor({kPlace, begin_s, begin_s + 2.0}, rng);
      squares += std::pow(reading.concentration_ppm - true_ppm, 2);
      EXPECT_DOUBLE_EQ(reading.variance_ppm2, std::max(0.1, 0.04 * reading.concentration_ppm));
    }
    EXPECT_NEAR(std::sqrt(squares / kReadings), sigma, 4.0 * sigma / std::sqrt(2.0 * kReadings));
  }
  EXPECT_EQ(sensor({{0.05, 1.15}, 0.0, 2.0}, rng).variance_ppm2, 0.1);  // clean air
}

TEST(DwellSensorTest, NeverReadsLessThanNothing) {
  const SceneWorld world = SteppingWorld();
  const DwellSensor sensor = MakeDwellSensor(world, {5.0, 0.0});
  Rng rng(2);
  double least = 1.0;
  for (int i = 0; i < 100; ++i) {
    least = std::min(least, sensor({{0.05, 1.15}, 0.0, 2.0}, rng).concentration_ppm);
  }
  EXPECT_EQ(least, 0.0);
}

TEST(DwellSensorTest, ADwellOfNoLengthReadsThatInstant) {
  const SceneWorld world = SteppingWorld();
  Rng rng(1);
  EXPECT_DOUBLE_EQ(MakeDwellSensor(world, {0.0, 0.0})({kPlace, 9.0, 9.0}, rng).concentration_ppm,
                   30.0);
}

}  // namespace dwell_sensor_test
}  // namespace plumescout::lab
