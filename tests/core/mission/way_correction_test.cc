// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/way_correction.h"

#include <cmath>

#include "gtest/gtest.h"

namespace plumescout {
namespace way_correction_test {

// East at 1 m a time unit.
std::vector<WayPoint> WayEast(double north_m = 0.0) {
  std::vector<WayPoint> way;
  for (int t = 0; t <= 10; ++t) way.push_back({t, {static_cast<double>(t), north_m, 0.0}});
  return way;
}

void ExpectNear(const Pose2& pose, const Pose2& expected) {
  EXPECT_NEAR(pose.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(pose.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(WrapAngle_rad(pose.yaw_rad - expected.yaw_rad), 0.0, 1e-9);
}

TEST(WayCorrection, OneAnchorMovesTheWayRigidly) {
  const WayCorrection correction(WayEast(), {{4, {4.0, 1.0, M_PI / 2}}});
  ExpectNear(correction.Corrected(4, {4.0, 0.0, 0.0}), {4.0, 1.0, M_PI / 2});
  ExpectNear(correction.Corrected(6, {6.0, 0.0, 0.0}), {4.0, 3.0, M_PI / 2});
  ExpectNear(correction.Corrected(1, {1.0, 0.0, 0.1}), {4.0, -2.0, M_PI / 2 + 0.1});
}

TEST(WayCorrection, BetweenAnchorsTheWayBends) {
  const WayCorrection correction(WayEast(), {{2, {2.0, 0.0, 0.0}}, {6, {6.0, 2.0, 0.0}}});
  ExpectNear(correction.Corrected(0, {0.0, 0.0, 0.0}), {0.0, 0.0, 0.0});
  ExpectNear(correction.Corrected(2, {2.0, 0.0, 0.0}), {2.0, 0.0, 0.0});
  ExpectNear(correction.Corrected(3, {3.0, 0.0, 0.0}), {3.0, 0.5, 0.0});
  ExpectNear(correction.Corrected(5, {5.0, 0.0, 0.0}), {5.0, 1.5, 0.0});
  ExpectNear(correction.Corrected(9, {9.0, 0.0, 0.0}), {9.0, 2.0, 0.0});
}

// The way from far away from the origin bends as it does there.
TEST(WayCorrection, DoesNotDependOnTheOrigin) {
  const std::vector<PoseAnchor> near = {{2, {2.0, 0.0, 0.0}}, {6, {6.0, 2.0, 0.4}}};
  std::vector<PoseAnchor> far = near;
  for (PoseAnchor& anchor : far) anchor.pose.y_m += 500.0;
  const WayCorrection here(WayEast(), near);
  const WayCorrection there(WayEast(500.0), far);
  for (int t = 0; t <= 10; ++t) {
    const Pose2 pose{static_cast<double>(t), 0.0, 0.0};
    Pose2 expected = here.Corrected(t, pose);
    expected.y_m += 500.0;
    ExpectNear(there.Corrected(t, {pose.x_m, 500.0, 0.0}), expected);
  }
}

TEST(WayCorrection, AnchorsMayLieBetweenPointsOfTheWay) {
  const std::vector<WayPoint> way = {{0, {0.0, 0.0, 0.0}}, {10, {10.0, 0.0, 0.0}}};
  ExpectNear(PoseOnWay(way, 5), {5.0, 0.0, 0.0});
  ExpectNear(PoseOnWay(way, 20), {10.0, 0.0, 0.0});
  const WayCorrection correction(way, {{5, {5.0, 3.0, 0.0}}});
  ExpectNear(correction.Corrected(10, {10.0, 0.0, 0.0}), {10.0, 3.0, 0.0});
}

}  // namespace way_correction_test
}  // namespace plumescout
