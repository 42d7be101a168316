// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/right_of_way.h"
#include "core/plan/way_round.h"
#include "core/types/plan.h"

namespace plumescout {

// A robot that plans anew on its way has the right to what is left of it: the candidate that its
// live plan's claim covers, if it would have to stand, goes on by that way in place of its own, as
// long as all of it may still be driven and it meets nobody who keeps to the time. Others have
// reckoned with it since it was committed, so that it waits for nobody. REQUIRES: duration_s of all
// candidates, without waits; `waits` are theirs, and stay so. Cost: that of two Traffic and of a
// FirstMeeting, for a robot on its way.
void GoOnOnWayLeft(const SearchedWays& ways, Waits& waits, Plan& plan);

}  // namespace plumescout
