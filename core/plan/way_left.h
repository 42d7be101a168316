// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/right_of_way.h"
#include "core/plan/way_round.h"
#include "core/types/plan.h"

namespace plumescout {

// A robot that plans anew on its way has the right to what is left of it, as long as all of that
// may still be driven and meets nobody who keeps to the time: others have reckoned with it since it
// was committed. The candidate that its live plan's claim covers goes on by that way in place of
// its own, if it would have to wait longer than the plan does. If there is no such candidate, what
// the plan was for is no more, and the way is one of its own, for what it tells alone
// (unseen_share = 0), where candidates are chosen by that. There it may begin in the inflated zone
// around obstacles, as most who wait do where they have just seen something. Not of plans that stop
// farther on, beyond the travel budget, or for who is to go home. REQUIRES: duration_s of all
// candidates, without waits; `waits` are theirs, and stay so. Cost: that of a Traffic and of a
// FirstMeeting.
void GoOnOnWayLeft(const SearchedWays& ways, Waits& waits, Plan& plan);

// When the robot had better ask for another plan on its way (Plan::replan_after_s): as
// options.team_replan_period_s says, if others are there that may have told much by then, and
// candidates are chosen by what they tell. Not where it stops to sample, nor on the way home.
double ReplanAfter_s(const Belief& belief, const PlanningOptions& options, const Plan& plan);

}  // namespace plumescout
