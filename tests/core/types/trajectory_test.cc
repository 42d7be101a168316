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

// Out along a corridor of 6 m at 1 m/s, a turn of 1 s, and back.
Trajectory OutAndBack() {
  Trajectory trajectory;
  trajectory.waypoints = {
      {{0, 0, 0}, 0.0}, {{6, 0, 0}, 6.0}, {{6, 0, M_PI}, 7.0}, {{0, 0, M_PI}, 13.0}};
  trajectory.duration_s = 13.0;
  return trajectory;
}

TEST(FindOnWay, GoesOutAndBackWithTheRobot) {
  const Trajectory way = OutAndBack();
  Rng rng(2);
  for (const double period_s : {0.1, 0.5, 1.5}) {
    for (const double error_m : {0.0, 0.04}) {
      double gone_s = 0.0;
      for (double time_s = 0.0; time_s <= 13.0; time_s += period_s) {
        Point2 place = PoseAt(way, time_s).position();
        place.x_m += rng.Uniform(-error_m, error_m);
        place.y_m += rng.Uniform(-error_m, error_m);
        gone_s = FindOnWay(way, place, gone_s)->time_s;
        const bool turns = time_s > 5.5 && time_s < 7.5;
        EXPECT_NEAR(gone_s, time_s, turns ? 1.3 : 0.16) << period_s << " s, " << error_m << " m";
      }
    }
  }
}

TEST(FindOnWay, OfALateRobotIsWhereItIs) {
  const Trajectory way = OutAndBack();
  double gone_s = 0.0;
  for (double x_m = 0.0; x_m < 5.0; x_m += 0.02) {  // at a fifth of the speed
    gone_s = FindOnWay(way, {x_m, 0.03}, gone_s)->time_s;
    EXPECT_NEAR(gone_s, x_m, 1e-9);
  }
}

TEST(FindOnWay, EndsWhereItBegan) {
  const Trajectory way = OutAndBack();
  EXPECT_EQ(FindOnWay(way, {0.0, 0.0}, 0.0)->time_s, 0.0);
  EXPECT_NEAR(FindOnWay(way, {0.1, 0.0}, 12.5)->time_s, 12.9, 1e-9);
  EXPECT_EQ(FindOnWay(way, {0.0, 0.0}, 13.0)->time_s, 13.0);
}

TEST(FindOnWay, WhoLeavesWhatIsLeftOfItIsWhereItIsNearest) {
  const Trajectory way = AllKinds();
  for (const double gone_s : {0.0, 3.0, 8.9}) {
    const NearestTime there = *FindOnWay(way, {0.5, 0.1}, gone_s);
    EXPECT_NEAR(there.time_s, 0.5, 1e-9);
    EXPECT_NEAR(there.distance_m, 0.1, 1e-9);
  }
  EXPECT_FALSE(FindOnWay({}, {0, 0}, 0.0).has_value());
}

TEST(FindNearest, OfNothingIsNone) { EXPECT_FALSE(FindNearest({}, {0, 0}).has_value()); }

}  // namespace trajectory_test
}  // namespace plumescout
