// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/belief/belief.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/trajectory.h"

namespace plumescout {

// Others go first whose plans are live: each candidate waits at its start until its way is clear of
// theirs, which adds to its duration_s; one that would have to wait longer than kMaxWait_s is
// rejected (kTraffic), the soonest reached first. Nothing if options.yield_to_robots is false.
// REQUIRES: duration_s of all candidates. Cost: that of Traffic::LeastWait_s for each candidate.
void YieldToRobots(const Belief& belief, double start_yaw_rad, const PlanningOptions& options,
                   Plan& plan);

// The candidate's trajectory, the wait for others included. REQUIRES: its duration_s, of
// YieldToRobots.
Trajectory TrajectoryOf(const Candidate& candidate, double start_yaw_rad,
                        const PlanningOptions& options);

// How long the trajectory stands before it leaves.
inline double WaitOf_s(const Trajectory& trajectory) {
  return trajectory.waypoints.empty() ? 0.0 : trajectory.waypoints.front().dwell_s;
}

}  // namespace plumescout
