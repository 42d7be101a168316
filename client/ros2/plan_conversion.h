// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "client/ros2/map_conversion.h"
#include "core/types/frontier.h"
#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"
#include "core/types/trajectory.h"
#include "formats/ros/view_messages.h"

namespace plumescout::client {

// A pose of the robot's own frame.
ros::PoseStamped ToPoseStamped(const ros::Header& header, const Pose2& in_robot);

// The way of a trajectory of the mission; empty for one without waypoints. Each pose has the
// header of the path.
ros::Path ToPath(const Trajectory& trajectory, const ViewPoint& view);

// Of each frontier its cells and where a robot would go for it; those of a message before are
// deleted first. Occupancy frontiers are blue, those of gas red, those that no robot goes to grey.
ros::MarkerArray ToMarkers(const std::vector<Frontier>& frontiers, const GridGeometry& geometry,
                           const ViewPoint& view);

}  // namespace plumescout::client
