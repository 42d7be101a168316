// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/options.h"
#include "core/types/pose2.h"
#include "core/types/trajectory.h"

namespace plumescout {

// `path` driven as the options of motion say: speed_mps, max_acceleration_mps2,
// max_turn_rate_rad_per_s and dwell_s. The robot stands for dwell_s at every vertex but the first
// (stop and sample, [XIT] section VII: it has sampled where it stands). Vertices that repeat the
// one before are left out. Without limits of acceleration and turning it drives at constant speed,
// and headings jump.
//
// With a limit of acceleration it stops at every vertex where the path bends or it dwells; speed in
// between follows a trapezoid (core/plan/speed_profile.h), whose corners are waypoints of their
// own. With a limit of the turn rate it turns on the spot before it goes on, from `start_yaw_rad`
// to begin with, and two waypoints lie where it does. Rounding corners would be quicker, but would
// leave the path that was checked for collisions.
//
// A path of no length keeps `start_yaw_rad`; an empty one gives an empty trajectory.
Trajectory TimeTrajectory(const std::vector<Point2>& path, double start_yaw_rad,
                          const PlanningOptions& options);

// The same, but the robot stands for dwell_s at `stops` alone: vertices of the path in its order,
// the first vertex perhaps among them.
Trajectory TimeTrajectory(const std::vector<Point2>& path, const std::vector<Point2>& stops,
                          double start_yaw_rad, const PlanningOptions& options);

}  // namespace plumescout
