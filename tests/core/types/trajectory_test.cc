// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kSpeed_mps = 1.25;

Trajectory Through(const std::vector<Point2>& points, double dwell_s = 0.0) {
  Trajectory trajectory;
  double time_s = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) time_s += Distance_m(points[i - 1], points[i]) / kSpeed_mps;
    const double dwell = i > 0 ? dwell_s : 0.0;
    trajectory.waypoints.push_back({{points[i].x_m, points[i].y_m, 0.0}, time_s, dwell});
    time_s += dwell;
  }
  return trajectory;
}

TEST(PoseAt, WalksTheSegmentsAtThePlannedTimes) {
  const Trajectory trajectory = Through({{0, 0}, {2.5, 0}, {2.5, 1.25}});

  EXPECT_EQ(PoseAt(trajectory, 0.0).position(), (Point2{0, 0}));
  EXPECT_EQ(PoseAt(trajectory, 1.0).position(), (Point2{1.25, 0}));
  EXPECT_EQ(PoseAt(trajectory, 2.0).position(), (Point2{2.5, 0}));
  EXPECT_EQ(PoseAt(trajectory, 2.5).position(), (Point2{2.5, 0.625}));
}

TEST(PoseAt, StandsStillWhileAWaypointDwells) {
  const Trajectory trajectory = Through({{0, 0}, {1.25, 0}, {2.5, 0}}, 5.0);

  EXPECT_EQ(PoseAt(trajectory, 1.0).position(), (Point2{1.25, 0}));
  EXPECT_EQ(PoseAt(trajectory, 5.9).position(), (Point2{1.25, 0}));
  EXPECT_EQ(PoseAt(trajectory, 6.5).position(), (Point2{1.875, 0}));
}

TEST(PoseAt, ClampsToTheEnds) {
  const Trajectory trajectory = Through({{1, 1}, {2, 1}});

  EXPECT_EQ(PoseAt(trajectory, -1.0).position(), (Point2{1, 1}));
  EXPECT_EQ(PoseAt(trajectory, 99.0).position(), (Point2{2, 1}));
}

TEST(PoseAt, SpeedsUpAndBrakesEvenlyBetweenSpeeds) {
  Trajectory trajectory;  // at 0.5 m/s^2 to 1 m/s and back
  trajectory.waypoints = {
      {{0, 0, 0}, 0.0, 0.0, 0.0}, {{1, 0, 0}, 2.0, 0.0, 1.0}, {{2, 0, 0}, 4.0, 0.0, 0.0}};

  EXPECT_NEAR(PoseAt(trajectory, 1.0).x_m, 0.25, kRounding);
  EXPECT_NEAR(PoseAt(trajectory, 2.0).x_m, 1.0, kRounding);
  EXPECT_NEAR(PoseAt(trajectory, 3.0).x_m, 1.75, kRounding);
}

TEST(PoseAt, TurnsOnTheSpotTheShorterWayRound) {
  Trajectory trajectory;
  trajectory.waypoints = {{{1, 1, 3.0}, 0.0, 1.0}, {{1, 1, -3.0}, 3.0, 0.0}};

  EXPECT_EQ(PoseAt(trajectory, 0.5), (Pose2{1, 1, 3.0})) << "it dwells";
  EXPECT_NEAR(PoseAt(trajectory, 2.0).yaw_rad, M_PI, kRounding);
  EXPECT_NEAR(PoseAt(trajectory, 2.5).yaw_rad, -3.0 - (M_PI - 3.0) / 2.0, kRounding);
}

}  // namespace
}  // namespace plumescout
