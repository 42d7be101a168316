// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout::client {
namespace transform_test {

constexpr double kTolerance = 1e-12;

void ExpectPose(const Transform& transform, const Pose2& pose) {
  const Pose2 planar = ToPlanar(transform);
  EXPECT_NEAR(planar.x_m, pose.x_m, kTolerance);
  EXPECT_NEAR(planar.y_m, pose.y_m, kTolerance);
  EXPECT_NEAR(WrapAngle_rad(planar.yaw_rad - pose.yaw_rad), 0.0, kTolerance);
}

TEST(Transform, ComposesAsPosesDo) {
  const Pose2 a{1.0, -2.0, 2.5};
  const Pose2 b{0.3, 0.7, 1.9};
  ExpectPose(Compose(FromPlanar(a), FromPlanar(b)), plumescout::Compose(a, b));
  ExpectPose(Inverse(FromPlanar(a)), plumescout::Inverse(a));
}

TEST(Transform, TurnsTheShorterWay) {
  const Transform a = FromPlanar({0.0, 0.0, 3.0});
  const Transform b = FromPlanar({1.0, 2.0, -3.0});
  const double gap_rad = 2.0 * M_PI - 6.0;
  ExpectPose(Interpolate(a, b, 0.25), {0.25, 0.5, 3.0 + 0.25 * gap_rad});
  ExpectPose(Interpolate(a, b, 0.0), {0.0, 0.0, 3.0});
  ExpectPose(Interpolate(a, a, 0.5), {0.0, 0.0, 3.0});
}

TEST(Transform, KnowsWhatIsUp) {
  Transform turned_over;
  turned_over.orientation = {1.0, 0.0, 0.0, 0.0};  // by half a turn about x
  EXPECT_NEAR(Upright(turned_over), -1.0, kTolerance);
  EXPECT_NEAR(Upright(FromPlanar({0.0, 0.0, 2.0})), 1.0, kTolerance);
}

TEST(Transform, RefusesWhatIsNone) {
  Transform transform;
  transform.orientation = {0.0, 0.0, 0.0, 0.0};
  EXPECT_FALSE(Normalise(transform).has_value());
  transform.orientation = {0.0, 0.0, 0.0, 2.0};
  ASSERT_TRUE(Normalise(transform).has_value());
  EXPECT_EQ(Normalise(transform)->orientation.w, 1.0);
  transform.position.z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Normalise(transform).has_value());
}

}  // namespace transform_test
}  // namespace plumescout::client
