// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lab/sim/episode.h"
#include "lab/sim/scene_world.h"

namespace plumescout::lab {

// How much of what a team did one robot did, [0, 1].
struct RobotShares {
  double area = 0.0;  // of the free cells that any of them saw, those that it saw first
  double readings = 0.0;
  double way = 0.0;  // of the metres driven
};

// Of each robot, in their order; all 0 of what nobody did. What is seen is what beams of this range
// meet in the true map, half a second apart, from where robots held themselves to be. Cost:
// O(poses * beams * range).
std::vector<RobotShares> SharesOf(const TeamResult& team, const SceneWorld& world, double range_m);

}  // namespace plumescout::lab
