// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/trajectory_timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace plumescout {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kRounding = 1e-12;

TEST(TimeTrajectory, DrivesAtConstantSpeed) {
  const Trajectory t = TimeTrajectory({{0, 0}, {3, 4}, {3, 6}}, 0.0, 2.0, 0.0);
  ASSERT_THAT(t.waypoints, SizeIs(3));
  EXPECT_EQ(t.waypoints[0].arrival_time_s, 0.0);
  EXPECT_NEAR(t.waypoints[1].arrival_time_s, 2.5, kRounding);
  EXPECT_NEAR(t.waypoints[2].arrival_time_s, 3.5, kRounding);
  EXPECT_NEAR(t.length_m, 7.0, kRounding);
  EXPECT_NEAR(t.duration_s, 3.5, kRounding);
}

TEST(TimeTrajectory, HeadsAlongTheSegmentThatLeavesAndKeepsTheLastHeading) {
  const Trajectory t = TimeTrajectory({{0, 0}, {0, 1}, {-1, 1}, {-1, 0}}, 3.0, 1.0, 0.0);
  EXPECT_NEAR(t.waypoints[0].pose.yaw_rad, M_PI / 2, kRounding);
  EXPECT_NEAR(t.waypoints[1].pose.yaw_rad, M_PI, kRounding);
  EXPECT_NEAR(t.waypoints[2].pose.yaw_rad, -M_PI / 2, kRounding);
  EXPECT_NEAR(t.waypoints[3].pose.yaw_rad, -M_PI / 2, kRounding);
}

TEST(TimeTrajectory, StandsAtEveryVertexButTheFirst) {
  const Trajectory t = TimeTrajectory({{0, 0}, {1, 0}, {2, 0}}, 0.0, 1.0, 5.0);
  EXPECT_EQ(t.waypoints[0].dwell_s, 0.0);
  EXPECT_EQ(t.waypoints[1].dwell_s, 5.0);
  EXPECT_EQ(t.waypoints[2].dwell_s, 5.0);
  EXPECT_NEAR(t.waypoints[1].arrival_time_s, 1.0, kRounding);
  EXPECT_NEAR(t.waypoints[2].arrival_time_s, 7.0, kRounding);
  EXPECT_NEAR(t.duration_s, 12.0, kRounding);
}

TEST(TimeTrajectory, LeavesOutRepeatedVertices) {
  const Trajectory t = TimeTrajectory({{0, 0}, {0, 0}, {1, 0}, {1, 0}}, 0.5, 1.0, 1.0);
  EXPECT_THAT(t.waypoints, SizeIs(2));
  EXPECT_NEAR(t.duration_s, 2.0, kRounding);
}

TEST(TimeTrajectory, OfNoLengthKeepsTheRobotsHeading) {
  const Trajectory t = TimeTrajectory({{2, 3}}, 0.5, 1.0, 1.0);
  ASSERT_THAT(t.waypoints, SizeIs(1));
  EXPECT_EQ(t.waypoints[0].pose, (Pose2{2, 3, 0.5}));
  EXPECT_EQ(t.duration_s, 0.0);
}

TEST(TimeTrajectory, OfNothingIsEmpty) {
  EXPECT_THAT(TimeTrajectory({}, 0.0, 1.0, 1.0).waypoints, IsEmpty());
}

}  // namespace
}  // namespace plumescout
