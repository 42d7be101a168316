// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/odometer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/types/rng.h"

namespace plumescout {
namespace odometer_test {

// Centred noise of the given standard deviation, even in a square.
Point2 Noisy(Point2 place, double deviation_m, Rng& rng) {
  const double half_m = deviation_m * std::sqrt(3.0);
  return {place.x_m + rng.Uniform(-half_m, half_m), place.y_m + rng.Uniform(-half_m, half_m)};
}

TEST(Odometer, BeginsWhereTheRobotIsFirstSeen) {
  Odometer odometer;
  EXPECT_EQ(odometer.travelled_m(), 0.0);
  odometer.Pass({50.0, 50.0});
  EXPECT_EQ(odometer.travelled_m(), 0.0);
  odometer.Pass({53.0, 54.0});
  EXPECT_EQ(odometer.travelled_m(), 5.0);
}

TEST(Odometer, DoesNotCountTheNoiseOfAStandingRobot) {
  Rng rng(1);
  Odometer odometer;
  for (int i = 0; i < 100'000; ++i) odometer.Pass(Noisy({3.0, 4.0}, 0.01, rng));
  EXPECT_EQ(odometer.travelled_m(), 0.0);
}

TEST(Odometer, IsLittleLongerThanAStraightWayWithNoise) {
  Rng rng(2);
  constexpr double kDeviation_m = 0.01;
  Odometer odometer;
  // 10 Hz at 0.15 m/s: many poses a step.
  for (int i = 0; i <= 10'000; ++i) odometer.Pass(Noisy({0.015 * i, 0.0}, kDeviation_m, rng));
  // The step at which the mark is left is one that noise has made long, the next begins there: at
  // most by the reach of the noise, so steps add up to the way but for the sideways noise.
  EXPECT_GT(odometer.travelled_m(), 150.0 * 0.98);
  EXPECT_LT(odometer.travelled_m(), 150.0 * 1.03);
}

TEST(Odometer, IsLittleShorterThanATightCircle) {
  Odometer odometer;
  constexpr double kRadius_m = 0.5;
  constexpr int kPoses = 1000;
  for (int i = 0; i <= kPoses; ++i) {
    const double angle_rad = 2.0 * M_PI * i / kPoses;
    odometer.Pass({kRadius_m * std::cos(angle_rad), kRadius_m * std::sin(angle_rad)});
  }
  // Chords of 0.1 m lose 0.1^2 / (24 R^2) = 0.2 %, and the last step is not full.
  EXPECT_LE(odometer.travelled_m(), 2.0 * M_PI * kRadius_m);
  EXPECT_GT(odometer.travelled_m(), 2.0 * M_PI * kRadius_m * 0.998 - 0.1);
}

TEST(Odometer, WhoFindsItselfElsewhereHasNotDrivenThere) {
  Odometer odometer;
  odometer.Pass({0.0, 0.0});
  odometer.Pass({1.0, 0.0});
  odometer.GoOnFrom({5.0, 5.0});
  odometer.Pass({5.0, 6.0});
  EXPECT_DOUBLE_EQ(odometer.travelled_m(), 2.0);
}

TEST(Odometer, WhatWasForgottenWasNotDrivenFrom) {
  Odometer odometer;
  odometer.Pass({0.0, 0.0});
  odometer.Pass({1.0, 0.0});
  odometer.Forget();
  odometer.Pass({9.0, 0.0});
  odometer.Pass({9.5, 0.0});
  EXPECT_EQ(odometer.travelled_m(), 1.5);
}

}  // namespace odometer_test
}  // namespace plumescout
