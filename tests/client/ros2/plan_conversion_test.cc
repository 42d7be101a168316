// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/plan_conversion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::client {
namespace plan_conversion_test {

TEST(ToPath, IsInTheRobotsFrame) {
  Trajectory trajectory;
  trajectory.waypoints = {{{2.0, 3.0, M_PI_2}}, {{2.0, 5.0, M_PI_2}}};
  const ViewPoint view{{{4, 5}, "map"}, {.mission_from_robot = {2.0, 3.0, M_PI_2}}};
  const ros::Path path = ToPath(trajectory, view);
  ASSERT_EQ(path.poses.size(), 2u);
  EXPECT_EQ(path.header.frame_id, "map");
  EXPECT_EQ(path.poses[1].header.stamp.sec, 4);
  EXPECT_NEAR(path.poses[1].pose.position.x, 2.0, 1e-12);
  EXPECT_NEAR(path.poses[1].pose.position.y, 0.0, 1e-12);
  EXPECT_NEAR(path.poses[1].pose.orientation.w, 1.0, 1e-12);
  EXPECT_TRUE(ToPath({}, view).poses.empty());
}

TEST(ToMarkers, ShowsCellsAndGoalsAfterHavingDeletedThoseOfBefore) {
  const GridGeometry geometry{0.0, 0.0, 0.5, 10, 10};
  Frontier open;
  open.kind = FrontierKind::kGas;
  open.cells = {{1, 2}, {1, 3}};
  open.goal_cell = {2, 2};
  open.reachable = true;
  Frontier far;
  far.cells = {{5, 5}};
  const auto markers = ToMarkers({open, far}, geometry, {{{}, "map"}, {}}).markers;
  ASSERT_EQ(markers.size(), 4u);
  EXPECT_EQ(markers[0].action, ros::Marker::kDeleteAll);
  EXPECT_EQ(markers[1].type, ros::Marker::kPoints);
  ASSERT_EQ(markers[1].points.size(), 2u);
  EXPECT_EQ(markers[1].points[1].y, 1.75);
  EXPECT_EQ(markers[1].scale.x, 0.5);
  EXPECT_EQ(markers[2].type, ros::Marker::kSphere);
  EXPECT_EQ(markers[2].pose.position.x, 1.25);
  EXPECT_GT(markers[2].color.r, markers[2].color.b) << "of gas";
  EXPECT_EQ(markers[3].points.size(), 1u) << "and no goal, for nobody can go there";
  EXPECT_NE(markers[1].id, markers[3].id);
}

}  // namespace plan_conversion_test
}  // namespace plumescout::client
