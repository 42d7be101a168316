// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/types/rng.h"

namespace plumescout {
namespace trajectory_test {

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

// A leg at constant speed, a dwell, and an accelerated leg with a turn on the spot between.
Trajectory AllKinds() {
  Trajectory trajectory;
  trajectory.waypoints = {{{0, 0, 0}, 0.0, 0.0},           {{2, 0, 0}, 2.0, 1.0},
                          {{2, 0, M_PI_2}, 4.0, 0.0},      {{2, 1, M_PI_2}, 6.0, 0.0, 1.0},
                          {{2, 2, M_PI_2}, 7.0, 0.0, 1.0}, {{2, 3, M_PI_2}, 9.0, 0.0, 0.0}};
  return trajectory;
}

TEST(FindNearest, FindsTheTimeAtWhichPoseAtIsThere) {
  const Trajectory trajectory = AllKinds();
  for (const double time_s : {0.5, 1.75, 4.5, 5.0, 6.25, 7.0, 7.5, 8.9, 9.0}) {
    const auto nearest = FindNearest(trajectory, PoseAt(trajectory, time_s).position());
    ASSERT_TRUE(nearest.has_value());
    EXPECT_NEAR(nearest->time_s, time_s, 1e-9);
    EXPECT_NEAR(nearest->distance_m, 0.0, 1e-9);
  }
}

TEST(FindNearest, IsNeverFartherThanAnyInstant) {
  const Trajectory trajectory = AllKinds();
  Rng rng(6);
  for (int trial = 0; trial < 200; ++trial) {
    const Point2 place = {rng.Uniform(-1, 4), rng.Uniform(-1, 4)};
    const NearestTime nearest = *FindNearest(trajectory, place);
    EXPECT_NEAR(Distance_m(PoseAt(trajectory, nearest.time_s).position(), place),
                nearest.distance_m, 1e-9);
    for (double time_s = 0.0; time_s <= 9.0; time_s += 0.05) {
      EXPECT_LE(nearest.distance_m,
                Distance_m(PoseAt(trajectory, time_s).position(), place) + 1e-9);
    }
  }
}

TEST(FindNearest, OfNothingIsNone) { EXPECT_FALSE(FindNearest({}, {0, 0}).has_value()); }

}  // namespace trajectory_test
}  // namespace plumescout
