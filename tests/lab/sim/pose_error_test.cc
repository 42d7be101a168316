// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/pose_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace pose_error_test {

constexpr Pose2 kTruth{1.25, -2.5, 0.75};

TEST(PoseErrorTest, IsNoneToTheLastBitUnlessAskedFor) {
  PoseError error({}, 1);
  error.Advance(100.0);
  const Pose2 beyond{1.0, 2.0, 4.0};  // not even its heading is brought into range
  EXPECT_EQ(error.Told(beyond), beyond);
  EXPECT_EQ(error.TrueFor(beyond), beyond);
}

TEST(PoseErrorTest, NoiseHasTheGivenSizeAndDoesNotGrow) {
  PoseError error({.position_sigma_m = 0.1, .yaw_sigma_rad = 0.02}, 1);
  constexpr int kDraws = 4000;
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Pose2 told = error.Told(kTruth);
    x += std::pow((told.x_m - kTruth.x_m) / 0.1, 2);
    y += std::pow((told.y_m - kTruth.y_m) / 0.1, 2);
    yaw += std::pow((told.yaw_rad - kTruth.yaw_rad) / 0.02, 2);
    error.Advance(1.0);
  }
  // Sums of squares of standard normal draws, to 4 standard deviations.
  for (const double squares : {x, y, yaw}) {
    EXPECT_NEAR(squares, kDraws, 4.0 * std::sqrt(2.0 * kDraws));
  }
}

TEST(PoseErrorTest, DriftGrowsWithTheRootOfTimeHoweverItIsStepped) {
  constexpr int kRobots = 2000;
  for (const int steps : {1, 9}) {
    double squares = 0.0;
    for (int robot = 0; robot < kRobots; ++robot) {
      PoseError error({.drift_m_per_sqrt_s = 0.05}, static_cast<std::uint64_t>(robot));
      for (int i = 0; i < steps; ++i) error.Advance(9.0 / steps);
      squares += std::pow((error.Told(kTruth).x_m - kTruth.x_m) / 0.15, 2);
    }
    EXPECT_NEAR(squares, kRobots, 4.0 * std::sqrt(2.0 * kRobots)) << steps;
  }
}

TEST(PoseErrorTest, StaysAsItIsWhileNoTimeGoesBy) {
  const PoseError error({.position_sigma_m = 0.1}, 1);
  EXPECT_EQ(error.Told(kTruth), error.Told(kTruth));
  EXPECT_NE(error.Told(kTruth), kTruth);
}

TEST(PoseErrorTest, DriftMisleadsARobotAndNoiseDoesNot) {
  PoseError noisy({.position_sigma_m = 0.1}, 1);
  EXPECT_EQ(noisy.TrueFor(kTruth), kTruth);
  PoseError drifting({.drift_m_per_sqrt_s = 0.1, .drift_rad_per_sqrt_s = 0.1}, 1);
  drifting.Advance(10.0);
  const Pose2 back = drifting.Told(drifting.TrueFor(kTruth));
  EXPECT_NEAR(back.x_m, kTruth.x_m, 1e-12);
  EXPECT_NEAR(back.y_m, kTruth.y_m, 1e-12);
  EXPECT_NEAR(back.yaw_rad, kTruth.yaw_rad, 1e-12);
}

TEST(PoseErrorTest, RejectsOptionsOutOfRange) {
  EXPECT_TRUE(Validate(PoseErrorOptions{}).ok());
  for (const double bad : {-0.1, 11.0, std::nan("")}) {
    EXPECT_TRUE(absl::IsInvalidArgument(Validate(PoseErrorOptions{.position_sigma_m = bad})));
    EXPECT_TRUE(absl::IsInvalidArgument(Validate(PoseErrorOptions{.yaw_sigma_rad = bad})));
    EXPECT_TRUE(absl::IsInvalidArgument(Validate(PoseErrorOptions{.drift_m_per_sqrt_s = bad})));
    EXPECT_TRUE(absl::IsInvalidArgument(Validate(PoseErrorOptions{.drift_rad_per_sqrt_s = bad})));
  }
}

}  // namespace pose_error_test
}  // namespace plumescout::lab
