// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/belief/belief.h"
#include "core/plan/departure.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/stop.h"

namespace plumescout {

// Robots that wait for each other in a ring do so for this long before one of them backs off. If
// that one does not, the next may after as long again, and so on.
inline constexpr double kRingPatience_s = 5.0;
// Who has made way stands aside for so long, that the others, who ask every second, go first.
inline constexpr double kStandAside_s = 3.0;

// Gives a robot that would stay a way (GoalKind::kMakeWay) off the ways of those for whom it is in
// the way (core/plan/blockade.h): to the nearest place, by the way to it, that keeps off the
// shortest ways of all who are blocked, or else of those whom the robot blocks, is no other robot's
// goal, and can be gone to without meeting anybody; off the ways that are kept for others
// (precedence.h) if there is such a place.
//
// A robot that wants nothing does so at once; one that wants to go somewhere itself, if it alone is
// in the way of somebody it does not wait for, who has waited for kRingPatience_s. Of robots that
// wait for each other in a ring the one with the shortest such way does, the first by id of equals.
//
// The plan is as it was otherwise, but that it is not complete; its explanation says for whom it
// makes way. Nothing if options.yield_to_robots is false. REQUIRES: plan.robot and what was
// rejected. Cost: that of FindBlockedRobots, and of a grid search for each robot of a ring.
void MakeWay(const Belief& belief, const Departure& departure, const PlanningOptions& options,
             const StopFn& stop, Plan& plan);

}  // namespace plumescout
