// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/map_snapshot.h"
#include "core/types/robot_frame.h"
#include "formats/ros/view_messages.h"

namespace plumescout::client {

// Where and when what is shown is: `header` names the robot's frame, of which `frame` says where it
// lies in the mission's.
struct ViewPoint {
  ros::Header header = {};
  RobotFrame frame = {};
};

// Free 0, occupied 100, unknown -1.
ros::OccupancyGrid ToOccupancyGrid(const Grid<CellState>& occupancy, const ViewPoint& view);

// From 0 to `top`, > 0, as 0 to 100, more as 100; NaN -1.
ros::OccupancyGrid ToScaledGrid(const Grid<float>& layer, float top, const ViewPoint& view);

// The largest value that is a number, or 1 if none is above 0.
float TopOf(const Grid<float>& layer);

// The gas of a mission as numbers: layers gas_mean_ppm and gas_variance_ppm2, and of further gases
// the same with _GAS. NaN where nothing is known.
ros::GridMap ToGridMap(const MapSnapshot& map, const ViewPoint& view);

}  // namespace plumescout::client
