// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/pose2.h"

namespace plumescout {

struct Waypoint {
  Pose2 pose;                   // heading along the segment that leaves it
  double arrival_time_s = 0.0;  // since departure
  double dwell_s = 0.0;         // standing time for stop-and-sample

  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};

// Timed polyline in frame map; the first waypoint is the start.
struct Trajectory {
  std::vector<Waypoint> waypoints;
  double length_m = 0.0;
  double duration_s = 0.0;  // dwell included

  friend bool operator==(const Trajectory&, const Trajectory&) = default;
};

}  // namespace plumescout
