// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/pose2.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace pose2_test {

TEST(Distance, IsEuclidean) { EXPECT_DOUBLE_EQ(Distance_m({1.0, 2.0}, {4.0, -2.0}), 5.0); }

TEST(WrapAngle, LeavesAnglesWithinHalfATurn) {
  for (const double angle_rad : {-3.0, -0.5, 0.0, 1.0, 3.0, M_PI}) {
    EXPECT_DOUBLE_EQ(WrapAngle_rad(angle_rad), angle_rad);
  }
}

TEST(WrapAngle, TakesWholeTurnsAway) {
  constexpr double kTolerance_rad = 1e-12;  // a few turns, rounded
  EXPECT_NEAR(WrapAngle_rad(4.0), 4.0 - 2.0 * M_PI, kTolerance_rad);
  EXPECT_NEAR(WrapAngle_rad(-4.0), 2.0 * M_PI - 4.0, kTolerance_rad);
  EXPECT_NEAR(WrapAngle_rad(1.0 + 20.0 * M_PI), 1.0, kTolerance_rad);
}

TEST(WrapAngle, MapsBothHalfTurnsToPlusPi) {
  EXPECT_DOUBLE_EQ(WrapAngle_rad(-M_PI), M_PI);
  EXPECT_DOUBLE_EQ(WrapAngle_rad(M_PI), M_PI);
}

TEST(Compose, TurnsAndMoves) {
  const Pose2 frame{1.0, 2.0, M_PI / 2};
  const Pose2 pose = Compose(frame, {3.0, 0.5, 0.25});
  EXPECT_NEAR(pose.x_m, 0.5, 1e-12);
  EXPECT_NEAR(pose.y_m, 5.0, 1e-12);
  EXPECT_NEAR(pose.yaw_rad, M_PI / 2 + 0.25, 1e-12);
  const Pose2 none = Compose(frame, Inverse(frame));
  EXPECT_NEAR(none.x_m, 0.0, 1e-12);
  EXPECT_NEAR(none.y_m, 0.0, 1e-12);
  EXPECT_NEAR(none.yaw_rad, 0.0, 1e-12);
}

}  // namespace pose2_test
}  // namespace plumescout
