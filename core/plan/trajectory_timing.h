// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/pose2.h"
#include "core/types/trajectory.h"

namespace plumescout {

// `path` driven at constant speed, standing for `dwell_s` at every vertex but the first (stop and
// sample, [XIT] section VII: the robot has sampled where it stands). Headings point along the
// segment that leaves a vertex; the last keeps the heading it arrives with, and a path of no
// length `start_yaw_rad`. Vertices that repeat the one before are left out. Turning takes
// no time. REQUIRES: speed_mps > 0. An empty path gives an empty trajectory.
Trajectory TimeTrajectory(const std::vector<Point2>& path, double start_yaw_rad, double speed_mps,
                          double dwell_s);

}  // namespace plumescout
