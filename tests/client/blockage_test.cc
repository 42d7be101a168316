// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/blockage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/client/fake_driver.h"

namespace plumescout::client {
namespace blockage_test {

// What a robot at `pose` sees of posts in a large empty room.
Scan ScanWithPosts(const Pose2& pose, std::vector<Point2> posts) {
  FakeDriver driver(10.0);
  driver.set_pose(pose);
  driver.posts = std::move(posts);
  return *driver.TakeScan();
}

TEST(PathBlocked, AnObstacleOnThePathBlocksIt) {
  const Scan scan = ScanWithPosts({}, {{0.5, 0.0}});

  EXPECT_TRUE(PathBlocked(scan, {}, {{0, 0}, {2, 0}}, {}));
}

TEST(PathBlocked, AnObstacleBesideThePathDoesNot) {
  const Scan scan = ScanWithPosts({}, {{0.5, 0.3}});

  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}, {2, 0}}, {}));
}

TEST(PathBlocked, ALargeRobotNeedsMoreRoom) {
  const Scan scan = ScanWithPosts({}, {{0.5, 0.3}});

  EXPECT_TRUE(PathBlocked(scan, {}, {{0, 0}, {2, 0}}, {.radius_m = 0.6}));
}

TEST(PathBlocked, WhatLiesBeyondTheLookaheadMayBeGoneWhenWeGetThere) {
  const Scan scan = ScanWithPosts({}, {{1.5, 0.0}});

  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}, {3, 0}}, {.lookahead_m = 0.8}));
}

TEST(PathBlocked, ItsEndKeepsFartherFromWhatTheMapDoesNotShow) {
  const Scan scan = ScanWithPosts({}, {{0.63, 0.0}});  // 8 cm beyond the end

  EXPECT_TRUE(PathBlocked(scan, {}, {{0, 0}, {0.5, 0}}, {}));
  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}, {0.5, 0}}, {.end_margin_m = 0.0}));
}

TEST(PathBlocked, WhereThePathGoesOnIsNoEnd) {
  const Scan scan = ScanWithPosts({}, {{0.5, 0.12}});

  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}, {0.5, 0}, {0.5, -1}}, {.min_beams = 1}));
  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}, {2, 0}}, {.lookahead_m = 0.5, .min_beams = 1}));
  EXPECT_TRUE(PathBlocked(scan, {}, {{0, 0}, {0.5, 0}}, {.min_beams = 1}));
}

TEST(PathBlocked, AtItsEndARobotIsNotHeldByWhatIsAsNear) {
  const Scan scan = ScanWithPosts({.x_m = 0.5}, {{0.63, 0.0}});

  EXPECT_FALSE(PathBlocked(scan, {.x_m = 0.5}, {{0.5, 0}, {0.51, 0}}, {}));
}

TEST(PathBlocked, TheLookaheadFollowsCorners) {
  const Scan scan = ScanWithPosts({}, {{0.3, 0.4}});
  const BlockageOptions options{.lookahead_m = 1.0};

  EXPECT_TRUE(PathBlocked(scan, {}, {{0, 0}, {0.3, 0}, {0.3, 2}}, options));
  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}, {0.3, 0}, {0.3, -2}}, options));
}

TEST(PathBlocked, TheScansHeadingIsAccountedFor) {
  const Pose2 pose{.x_m = 1.0, .y_m = 1.0, .yaw_rad = 2.0};
  const Scan scan = ScanWithPosts(pose, {{1.5, 1.0}});

  EXPECT_TRUE(PathBlocked(scan, pose, {{1, 1}, {3, 1}}, {}));
  EXPECT_FALSE(PathBlocked(scan, pose, {{1, 1}, {-1, 1}}, {}));
}

TEST(PathBlocked, DrivingAwayFromSomethingCloseIsNotBlocked) {
  const Scan scan = ScanWithPosts({}, {{-0.1, 0.0}});

  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}, {2, 0}}, {}));
}

TEST(PathBlocked, OneGlitchIsNotAnObstacle) {
  Scan scan = ScanWithPosts({}, {});
  scan.ranges_m[0] = 0.5F;

  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}, {2, 0}}, {.min_beams = 2}));
  EXPECT_TRUE(PathBlocked(scan, {}, {{0, 0}, {2, 0}}, {.min_beams = 1}));
}

TEST(PathBlocked, BeamsThatSayNothingBlockNothing) {
  Scan scan = ScanWithPosts({}, {});
  for (float& range : scan.ranges_m) range = std::numeric_limits<float>::quiet_NaN();
  scan.ranges_m[0] = 0.0F;
  scan.ranges_m[1] = -1.0F;
  scan.ranges_m[2] = std::numeric_limits<float>::infinity();

  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}, {2, 0}}, {.min_beams = 1}));
}

TEST(PathBlocked, NoPathIsNeverBlocked) {
  const Scan scan = ScanWithPosts({}, {{0.1, 0.0}});

  EXPECT_FALSE(PathBlocked(scan, {}, {}, {}));
  EXPECT_FALSE(PathBlocked(scan, {}, {{0, 0}}, {}));
}

}  // namespace blockage_test
}  // namespace plumescout::client
