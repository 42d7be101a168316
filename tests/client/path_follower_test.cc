// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/path_follower.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/types/rng.h"
#include "tests/client/fake_driver.h"

namespace plumescout::client {
namespace path_follower_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kSpeed_mps = 1.25;

Trajectory Through(const std::vector<Point2>& points, double dwell_s = 0.0) {
  Trajectory trajectory;
  double time_s = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) {
      time_s += Distance_m(points[i - 1], points[i]) / kSpeed_mps;
      trajectory.length_m += Distance_m(points[i - 1], points[i]);
    }
    const double dwell = i > 0 ? dwell_s : 0.0;
    trajectory.waypoints.push_back(
        {.pose = {points[i].x_m, points[i].y_m, 0.0}, .arrival_time_s = time_s, .dwell_s = dwell});
    time_s += dwell;
  }
  trajectory.duration_s = time_s;
  return trajectory;
}

struct Drive {
  double time_s = 0.0;
  double worst_offset_m = 0.0;  // from the polyline
  bool arrived = false;
};

double OffsetFrom_m(const std::vector<Point2>& polyline, Point2 p) {
  double best_m = Distance_m(polyline[0], p);
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    constexpr int kPieces = 200;
    for (int k = 0; k <= kPieces; ++k) {
      const double s = static_cast<double>(k) / kPieces;
      best_m =
          std::min(best_m, Distance_m(p, {std::lerp(polyline[i - 1].x_m, polyline[i].x_m, s),
                                          std::lerp(polyline[i - 1].y_m, polyline[i].y_m, s)}));
    }
  }
  return best_m;
}

Drive Follow(FakeDriver& driver, const std::vector<Point2>& points, double dwell_s = 0.0) {
  const FollowerOptions options;
  PathFollower follower(Through(points, dwell_s), options);
  Drive drive;
  while (drive.time_s < 120.0) {
    EXPECT_TRUE(driver.Drive(follower.Step(driver.pose(), driver.now_ns())).ok());
    if (follower.done()) {
      drive.arrived = true;
      break;
    }
    EXPECT_TRUE(driver.Advance(options.tick_s).ok());
    drive.time_s += options.tick_s;
    drive.worst_offset_m =
        std::max(drive.worst_offset_m, OffsetFrom_m(points, driver.pose().position()));
  }
  return drive;
}

TEST(PathFollower, OnAStraightLineItKeepsThePlannedSpeed) {
  FakeDriver driver;

  const Drive drive = Follow(driver, {{0, 0}, {4, 0}});

  EXPECT_TRUE(drive.arrived);
  EXPECT_NEAR(drive.time_s, 4.0 / kSpeed_mps, 0.2);  // a tick at either end
  EXPECT_NEAR(driver.pose().y_m, 0.0, 1e-9);
}

TEST(PathFollower, TurnRateIsProportionalToTheHeadingErrorUpToItsLimit) {
  const FollowerOptions options;
  PathFollower follower(Through({{0, 0}, {3, 0}}), options);

  EXPECT_NEAR(follower.Step({.x_m = 1.0, .yaw_rad = 0.1}, 0).turn_rad_per_s,
              -0.1 * options.turn_gain_per_s, 1e-12);
  EXPECT_EQ(follower.Step({.x_m = 1.0, .yaw_rad = -2.0}, 0).turn_rad_per_s,
            options.max_turn_rad_per_s);
}

TEST(PathFollower, FacingAwayItTurnsOnTheSpot) {
  PathFollower follower(Through({{0, 0}, {3, 0}}), {});

  EXPECT_EQ(follower.Step({.x_m = 1.0, .yaw_rad = M_PI}, 0).forward_mps, 0.0);
}

TEST(PathFollower, SharpCornersAreKeptWithinTheTolerance) {
  FakeDriver driver;

  const Drive drive = Follow(driver, {{0, 0}, {2, 0}, {2, 2}, {0.5, 0.5}, {0.5, 3}});

  EXPECT_TRUE(drive.arrived);
  EXPECT_LT(drive.worst_offset_m, FollowerOptions{}.arrival_tolerance_m);
}

TEST(PathFollower, EveryWaypointOfRandomPathsIsReachedFromAnyHeading) {
  Rng rng(5);
  for (int trial = 0; trial < 50; ++trial) {
    FakeDriver driver;
    driver.set_pose({.yaw_rad = rng.Uniform(-M_PI, M_PI)});
    std::vector<Point2> points = {{0, 0}};
    for (int i = 0; i < 5; ++i) points.push_back({rng.Uniform(-3, 3), rng.Uniform(-3, 3)});

    EXPECT_TRUE(Follow(driver, points).arrived) << "trial " << trial;
  }
}

TEST(PathFollower, DwellsAtEachWaypointAndThenGoesOn) {
  FakeDriver driver;

  const Drive drive = Follow(driver, {{0, 0}, {1, 0}, {2, 0}}, 5.0);

  EXPECT_TRUE(drive.arrived);
  EXPECT_NEAR(drive.time_s, 2.0 / kSpeed_mps + 2 * 5.0, 0.6);  // a few ticks
}

TEST(PathFollower, WhereThePlanTurnsOnTheSpotItTurnsAndGoesOn) {
  FakeDriver driver;
  Trajectory trajectory;
  trajectory.waypoints = {{{0, 0, 0}, 0.0, 0.0},
                          {{1, 0, 0}, 1.0, 0.0},
                          {{1, 0, M_PI_2}, 3.0, 0.0},  // two seconds of turning
                          {{1, 1, M_PI_2}, 4.0, 0.0}};
  PathFollower follower(trajectory, {});
  for (int tick = 0; tick < 100 && !follower.done(); ++tick) {
    ASSERT_TRUE(driver.Drive(follower.Step(driver.pose(), driver.now_ns())).ok());
    ASSERT_TRUE(driver.Advance(FollowerOptions{}.tick_s).ok());
  }

  EXPECT_TRUE(follower.done());
  EXPECT_LE(Distance_m(driver.pose().position(), {1, 1}), FollowerOptions{}.arrival_tolerance_m);
}

TEST(PathFollower, PathAheadBeginsAtTheRobotAndLeavesOutWhatIsBehind) {
  PathFollower follower(Through({{0, 0}, {1, 0}, {2, 0}}), {});
  follower.Step({.x_m = 1.0}, kSecond_ns);

  EXPECT_THAT(follower.PathAhead({1.0, 0.05}),
              ::testing::ElementsAre(Point2{1.0, 0.05}, Point2{2, 0}));
}

TEST(PathFollower, NothingToFollowIsDoneAtOnce) {
  PathFollower follower({}, {});

  EXPECT_TRUE(follower.done());
  EXPECT_EQ(follower.Step({}, 0).forward_mps, 0.0);
}

}  // namespace path_follower_test
}  // namespace plumescout::client
