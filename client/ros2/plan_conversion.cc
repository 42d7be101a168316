// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/plan_conversion.h"

#include <utility>

#include "client/ros2/transform.h"

namespace plumescout::client {
namespace {

constexpr double kGoalSize_m = 0.3;
constexpr ros::Color kOccupancyColor = {0.1F, 0.4F, 0.9F, 1.0F};
constexpr ros::Color kGasColor = {0.9F, 0.2F, 0.1F, 1.0F};
constexpr ros::Color kNoGoalColor = {0.6F, 0.6F, 0.6F, 0.6F};

ros::Color ColorOf(const Frontier& frontier) {
  if (!frontier.reachable || frontier.too_small) return kNoGoalColor;
  return frontier.kind == FrontierKind::kGas ? kGasColor : kOccupancyColor;
}

ros::Vector3 ToPoint(Point2 in_mission, const ViewPoint& view) {
  const Pose2 place = InRobot(view.frame, {in_mission.x_m, in_mission.y_m, 0.0});
  return {place.x_m, place.y_m, 0.0};
}

ros::Marker MarkerOf(const Frontier& frontier, std::int32_t type, double size_m,
                     const ViewPoint& view) {
  ros::Marker marker;
  marker.header = view.header;
  marker.ns = type == ros::Marker::kPoints ? "frontiers" : "frontier_goals";
  marker.type = type;
  marker.scale = {size_m, size_m, size_m};
  marker.color = ColorOf(frontier);
  return marker;
}

}  // namespace

ros::PoseStamped ToPoseStamped(const ros::Header& header, const Pose2& in_robot) {
  return {.header = header, .pose = FromPlanar(in_robot)};
}

ros::Path ToPath(const Trajectory& trajectory, const ViewPoint& view) {
  ros::Path path;
  path.header = view.header;
  for (const Waypoint& waypoint : trajectory.waypoints) {
    path.poses.push_back(ToPoseStamped(view.header, InRobot(view.frame, waypoint.pose)));
  }
  return path;
}

ros::MarkerArray ToMarkers(const std::vector<Frontier>& frontiers, const GridGeometry& geometry,
                           const ViewPoint& view) {
  ros::MarkerArray message;
  ros::Marker clear;
  clear.header = view.header;
  clear.action = ros::Marker::kDeleteAll;
  message.markers.push_back(std::move(clear));
  std::int32_t id = 0;
  for (const Frontier& frontier : frontiers) {
    ros::Marker cells = MarkerOf(frontier, ros::Marker::kPoints, geometry.resolution_m, view);
    cells.id = id++;
    for (const Cell cell : frontier.cells) {
      cells.points.push_back(ToPoint(geometry.Center(cell), view));
    }
    message.markers.push_back(std::move(cells));
    if (!frontier.reachable || frontier.too_small) continue;
    ros::Marker goal = MarkerOf(frontier, ros::Marker::kSphere, kGoalSize_m, view);
    goal.id = id++;
    goal.pose.position = ToPoint(geometry.Center(frontier.goal_cell), view);
    message.markers.push_back(std::move(goal));
  }
  return message;
}

}  // namespace plumescout::client
