// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/belief/belief.h"
#include "core/types/options.h"
#include "core/types/plan.h"

namespace plumescout {

// A robot whose trajectory begins with a wait, and that stands there in the only way of another
// that waits (core/plan/blockade.h), drives on first and waits at a later stop: the last at which
// it is in the way of none of these, nor of anybody else who waits, if the whole is still clear of
// everybody. Its duration stays as it is. Stops are waypoints where it stands, or where its speed
// jumps. Nothing if options.dwell_s is not 0, for then stops have a dwell of their own.
//
// Returns whether the trajectory was changed. REQUIRES: the trajectory of plan.robot is that of
// TrajectoryOf. Cost: O(1) without a wait; else that of FindBlockedRobots, and if there is somebody
// that of a Traffic::FirstMeeting for each stop, and FindBlockedRobots once more for those that are
// clear.
bool WaitOutOfTheWay(const Belief& belief, const PlanningOptions& options, Plan& plan);

}  // namespace plumescout
