// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/belief/belief.h"
#include "core/traffic/traffic.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/stop.h"
#include "core/types/trajectory.h"

namespace plumescout {

// Where the others will be for a robot that plans now, those who go before it (precedence.h)
// included. Cost: that of Traffic and of KeptWays.
Traffic TrafficAround(const Belief& belief, const RobotId& robot, const PlanningOptions& options);

// For the robot of a plan. Who goes home, since it is sent there or has no budget for anything
// else, or asks to, may have no time: no ways are kept free from it, and live plans are all it
// yields to.
Traffic TrafficFor(const Belief& belief, const Plan& plan, const PlanningOptions& options);

// That, and what it makes of the candidates of a plan.
struct Waits {
  Traffic traffic;
  // Of each candidate before it leaves (Traffic::LeastWait_s); none: no wait would do.
  std::vector<std::optional<double>> waits_s;
};

// None if nobody is yielded to: robots are not, by options.yield_to_robots, or there is no other,
// or no candidate. REQUIRES: plan.robot. Cost: that of KeptWays, and of Traffic::LeastWait_s for
// each candidate.
std::optional<Waits> FindWaits(const Belief& belief, double start_yaw_rad,
                               const PlanningOptions& options, const Plan& plan);
// The same, but once `stop` says so only until the best of the candidates left is clear; those
// after it are rejected (kSearchStopped). Nothing is priced any more, so that none of them would be
// chosen.
std::optional<Waits> FindWaitsUntil(const StopFn& stop, const Belief& belief, double start_yaw_rad,
                                    const PlanningOptions& options, Plan& plan);

// Others go first whose plans are live, and who have waited for long (precedence.h): each candidate
// waits at its start until its way is clear of theirs, which adds to its duration_s; one that would
// have to wait longer than kMaxWait_s is rejected (kTraffic), the soonest reached first. If none is
// left the plan waits for the robot in the way of the first (Plan::waits_for). REQUIRES: duration_s
// of all candidates; `waits` are theirs. Cost: that of Traffic::FirstMeeting for each that is
// rejected.
void YieldToRobots(const Waits& waits, double start_yaw_rad, const PlanningOptions& options,
                   Plan& plan);
// By FindWaits.
void YieldToRobots(const Belief& belief, double start_yaw_rad, const PlanningOptions& options,
                   Plan& plan);

// If the chosen candidate waits before it leaves, the plan does so for the robot that it would meet
// if it left at once. REQUIRES: a choice; its duration_s, of YieldToRobots. Cost: that of
// TrafficFor and of Traffic::FirstMeeting, if it waits.
void NoteWhomItWaitsFor(const Belief& belief, double start_yaw_rad, const PlanningOptions& options,
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
