// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/types/ids.h"
#include "core/types/pose2.h"
#include "lab/sim/scene_world.h"

namespace plumescout::lab {

// How far apart the robots of a team start, centre to centre.
inline constexpr double kStartSpacing_m = 0.6;

// Places for `robots` >= 1 robots to start: the scene's, then the nearest ones by travel that keep
// the spacing and touch no obstacle with a body of this radius, all looking the same way.
// kInvalidArgument if the building has not so many.
absl::StatusOr<std::vector<Pose2>> TeamStarts(const SceneWorld& world, int robots,
                                              double body_radius_m);

// Names of `robots` >= 1 robots, counting on from the first: "robot-1", "robot-2", ... or "scout",
// "scout-2", ...
std::vector<RobotId> TeamNames(const RobotId& first, int robots);

}  // namespace plumescout::lab
