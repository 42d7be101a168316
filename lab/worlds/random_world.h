// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/belief/belief.h"
#include "core/types/plan.h"

namespace plumescout::lab {

// An indoor scene in the middle of a mission, made up from a seed: what a planner gets to see.
struct RandomWorld {
  Belief belief;  // one robot, `robot`, with its pose
  RobotId robot;
  std::vector<Goal> goals;  // the largest occupancy frontiers, reachable on the grid
};

// A hall of 16 x 20 m in cells of 0.1 m with an outer wall, three partition walls with doors of 1.0
// to 1.4 m, and 14 containers of 2.4 x 1.2 m; explored by a robot with a lidar of 6 to 8 m range
// that drives to the nearest frontier until it knows 60 % of the cells it can reach; with three
// plumes, and a variance that rises with the distance from the way driven. Worlds with fewer than
// `goal_count` frontiers left, or whose robot stands too near an obstacle or is shut in, are made
// anew.
RandomWorld MakeRandomWorld(std::uint64_t seed, int goal_count);

}  // namespace plumescout::lab
