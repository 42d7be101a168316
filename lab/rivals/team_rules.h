// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"

namespace plumescout::lab {

// How others choose which robot drives to which frontier: what each frontier is worth to a robot
// that asks now, in their papers' units; the greatest is taken. `goals` are the frontiers that it
// may drive to, `taken` where the other robots are driving to.

// Burgard, Moors, Stachniss and Schneider, Coordinated Multi-Robot Exploration (IEEE T-RO 21-3,
// 2005): U_t - beta V_t. Every frontier has utility 1, less P(d) = 1 - d / range for each that was
// taken at a distance d below the range from which it can be seen; V_t is the way there. Their beta
// may be anything from 0.01 to 50 without a difference in their runs; ways are in ranges here, and
// beta is 1.
struct BurgardOptions {
  double range_m = 8.0;  // of the lidar
  double beta = 1.0;
};
std::vector<double> BurgardValues(const std::vector<Point2>& goals,
                                  const std::vector<double>& travel_m,
                                  const std::vector<Point2>& taken,
                                  const Grid<CellState>& occupancy, const BurgardOptions& options);

// hasauino/rrt_exploration, assigner.py, with its defaults: 3 times the unknown area within a metre
// of a frontier's centroid, twice that within 3 m of the robot, less the straight distance. Unknown
// area that is within a metre of one that was taken too counts for nothing: the program subtracts 1
// for each such cell from an area in m^2, where the area of the cell is meant.
struct RrtRuleOptions {
  double radius_m = 1.0;
  double weight_per_m = 3.0;
  double near_m = 3.0;
  double near_gain = 2.0;
};
std::vector<double> RrtRevenues(Point2 robot, const std::vector<Point2>& goals,
                                const std::vector<Point2>& taken, const Grid<CellState>& occupancy,
                                const RrtRuleOptions& options);

// Matching: each robot gets a goal so that all ways together are shortest (LeastAssignment), as
// Wurm, Stachniss and Burgard have it for the parts of a building (IROS 2008). If there are more
// robots than goals these are handed out as often as it takes. `travel_m` by robot and goal;
// infinite where the robot cannot go. Returns the goal of each robot. REQUIRES: a goal.
std::vector<std::size_t> MatchGoals(std::vector<std::vector<double>> travel_m);

}  // namespace plumescout::lab
