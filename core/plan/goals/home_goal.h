// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/goals/goal_offer.h"
#include "core/types/plan.h"

namespace plumescout {

// HOME for the robot of a query: the mission's, or else where its first observation was taken; the
// place it starts from before there is one. It drives to the nearest cell that it can reach, by the
// way over free cells from home: a robot that came out of its dock in the inflated zone ends in
// front of it. If that is farther off than such a dock can be, home is not reachable. Where another
// robot stands already, home is the nearest cell with room beside it.
struct HomeGoal {
  Goal goal;               // its cell and position are home's own if not reachable
  bool reachable = false;  // home is on the map, and there is a way to it or to in front of it
  bool is_there = false;   // the robot is as near as it needs to be
};

// Neither memory nor claims of others keep a robot from going home. Cost: O(cells) if home is in
// the inflated zone, else O(1).
HomeGoal FindHome(const GoalQuery& query);

}  // namespace plumescout
