// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/types/pose2.h"

namespace plumescout {

struct Waypoint {
  Pose2 pose;                   // heading along the segment that leaves it, or with which it ends
  double arrival_time_s = 0.0;  // since departure
  double dwell_s = 0.0;         // standing time for stop-and-sample
  double speed_mps = 0.0;       // in passing; 0 where it stands, or if speed jumps here

  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};

// Timed polyline in frame map; the first waypoint is the start. Between two waypoints speed grows
// or falls evenly from the one's to the other's; if both are 0, it is constant. Where two lie at
// one place the robot turns on the spot, evenly, the shorter way round.
struct Trajectory {
  std::vector<Waypoint> waypoints;
  double length_m = 0.0;
  double duration_s = 0.0;  // dwell included

  friend bool operator==(const Trajectory&, const Trajectory&) = default;
};

// Where the robot is `time_s` after departure. Clamped to the ends. REQUIRES: waypoints not empty.
// Cost: O(waypoints).
Pose2 PoseAt(const Trajectory& trajectory, double time_s);

// When the robot is nearest to a place, and how near.
struct NearestTime {
  double time_s = 0.0;
  double distance_m = 0.0;
};

// The earliest of them; none if the trajectory is empty. While it stands there: when it leaves.
// Cost: O(waypoints).
std::optional<NearestTime> FindNearest(const Trajectory& trajectory, Point2 place);

// The same of a robot that has come as far as `gone_s`: of the times at which the way passes there,
// as near as poses tell, the first from then on, for a way may lead back where it led out. Who is
// at none of them any more is where FindNearest says. Cost: O(waypoints).
std::optional<NearestTime> FindOnWay(const Trajectory& trajectory, Point2 place, double gone_s);

}  // namespace plumescout
