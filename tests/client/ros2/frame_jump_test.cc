// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/frame_jump.h"

#include <gtest/gtest.h>

namespace plumescout::client {
namespace frame_jump_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// The robot drives along x at 1 m/s, in an odometry that lies at the origin of the map.
void Drive(FrameJump& jump, int from_s, int to_s) {
  for (int t = from_s; t <= to_s; ++t) {
    const Transform place = FromPlanar({static_cast<double>(t), 0.0, 0.0});
    jump.NoteSensed(t * kSecond_ns, place, place);
  }
}

TEST(FrameJump, SpreadsDriftOverTheWay) {
  FrameJump jump({.distance_m = 0.3});
  Drive(jump, 0, 10);
  jump.Move({}, FromPlanar({0.0, 1.0, 0.0}));
  const auto correction = jump.Take();
  ASSERT_TRUE(correction.has_value());
  ASSERT_EQ(correction->anchors.size(), 11u);
  EXPECT_EQ(correction->anchors.front().pose, (Pose2{0.0, 0.0, 0.0}));
  EXPECT_NEAR(correction->anchors[5].pose.y_m, 0.5, 1e-12);
  EXPECT_NEAR(correction->anchors.back().pose.y_m, 1.0, 1e-12);
  EXPECT_EQ(correction->anchors.back().sample_time_ns, 10 * kSecond_ns);
  EXPECT_FALSE(jump.Take().has_value());
}

TEST(FrameJump, MovesTheWholeWayAfterARelocalisation) {
  FrameJump jump({.distance_m = 0.3, .is_drift = false});
  Drive(jump, 0, 4);
  jump.Move({}, FromPlanar({0.0, 1.0, 0.0}));
  const auto correction = jump.Take();
  ASSERT_TRUE(correction.has_value());
  EXPECT_EQ(correction->anchors.size(), 5u);
  for (const PoseAnchor& anchor : correction->anchors) EXPECT_NEAR(anchor.pose.y_m, 1.0, 1e-12);
}

TEST(FrameJump, LetsSmallStepsPass) {
  FrameJump jump({.distance_m = 0.3, .angle_rad = 0.2});
  Drive(jump, 0, 4);
  jump.Move({}, FromPlanar({0.2, 0.2, 0.1}));
  EXPECT_FALSE(jump.Take().has_value());
  jump.Move({}, FromPlanar({0.0, 0.0, 0.3}));
  EXPECT_TRUE(jump.Take().has_value());
  EXPECT_EQ(jump.jumps(), 1);
}

TEST(FrameJump, JoinsTwoThatNobodyTookInBetween) {
  FrameJump jump({.distance_m = 0.3});
  Drive(jump, 0, 4);
  jump.Move({}, FromPlanar({0.0, 1.0, 0.0}));
  Drive(jump, 5, 8);
  jump.Move({}, FromPlanar({0.0, -1.0, 0.0}));
  const auto correction = jump.Take();
  ASSERT_TRUE(correction.has_value());
  for (std::size_t i = 1; i < correction->anchors.size(); ++i) {
    EXPECT_LT(correction->anchors[i - 1].sample_time_ns, correction->anchors[i].sample_time_ns);
  }
  EXPECT_EQ(correction->anchors.size(), 9u);
}

TEST(FrameJump, KeepsTheEndsOfALongWay) {
  FrameJump jump({.distance_m = 0.3});
  Drive(jump, 0, 5000);
  jump.Move({}, FromPlanar({0.0, 1.0, 0.0}));
  const auto correction = jump.Take();
  ASSERT_TRUE(correction.has_value());
  EXPECT_LE(correction->anchors.size(), 256u);
  EXPECT_EQ(correction->anchors.front().sample_time_ns, 0);
  EXPECT_EQ(correction->anchors.back().sample_time_ns, 5000 * kSecond_ns);
}

TEST(FrameJump, BeginsAnewWhenTheClockIsSetBack) {
  FrameJump jump({.distance_m = 0.3});
  Drive(jump, 100, 104);
  Drive(jump, 3, 5);
  jump.Move({}, FromPlanar({0.0, 1.0, 0.0}));
  EXPECT_EQ(jump.Take()->anchors.size(), 3u);
}

}  // namespace frame_jump_test
}  // namespace plumescout::client
