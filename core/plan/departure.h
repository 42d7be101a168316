// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/types/options.h"
#include "core/types/plan_request.h"
#include "core/types/pose2.h"

namespace plumescout {

// Where the robot of `request` starts: request.start; or, while it follows a live plan, where that
// has it options.planning_latency_s after it passed the point nearest to its latest pose; or its
// latest pose. A robot that strayed from its plan does not follow it.
// Errors: kFailedPrecondition if it has no pose; kInvalidArgument if the start is not finite or
// outside the map.
absl::StatusOr<Pose2> StartPose(const Belief& belief, const PlanRequest& request,
                                const RobotRecord& robot, const PlanningOptions& options);

// Where the search for paths begins.
struct Departure {
  std::vector<Point2> way_out;  // from the robot to before `start`; empty if it may drive already
  Point2 start;                 // in a traversable cell
  double yaw_rad = 0.0;         // of the robot, for whoever times its turns
};

// The robot's own place if its cell is traversable; else the way out of the inflated zone
// (EscapePath), which begins with the robot's place and the centre of its cell. None if there is no
// such way. REQUIRES: `robot` is inside the map. Cost: O(1), O(cells) in the inflated zone.
std::optional<Departure> Depart(const Belief& belief, Point2 robot);

// Where a robot that departs from a place can drive to.
struct Reach {
  Cell start;                    // where the search for paths begins; the place's own if nowhere
  Grid<std::uint8_t> reachable;  // 1: traversable and connected to `start`; nowhere: all 0
};

// REQUIRES: `place` is inside the map. Cost: O(cells).
Reach ReachFrom(const Belief& belief, Point2 place);

}  // namespace plumescout
