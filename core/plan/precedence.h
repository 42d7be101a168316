// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "core/types/options.h"
#include "core/types/trajectory.h"

namespace plumescout {

// In the order of commitment a robot whose way others take again and again would wait for ever. Who
// has stood for so long since its last leg, wanting to go where others are in the way
// (RobotRecord::wanted_since_ns), goes before those who plan next.
inline constexpr double kPrecedenceAfter_s = 15.0;
// For so long; if it has not gone by then it waits for its turn again, so that one that never goes
// holds nobody up for good.
inline constexpr double kPrecedenceFor_s = 30.0;

// The way to what a robot wants, with the wait at its start that live plans ask for; kHorizon_s of
// traffic, beyond which nobody is foreseen to meet it, if none does.
struct KeptWay {
  RobotId robot;
  Trajectory trajectory;
};

// The ways that are kept free for those who go before this robot: none of them is live, and what it
// plans is to keep clear of them as if they were, and not to end on them (Traffic::KeepWay). Of
// those who have waited for so long who has had the fewest turns goes first, then who began
// earlier, the first by id of equals. Of those who have had as many turns another begins each time,
// so that one that makes nothing of its turns does not keep them from the others.
// If this robot stands in the only such way it may drive off as it likes, along it too, and only
// not end on it; where another stands in it nothing is kept (see make_way.h). In the order of ids.
// Cost: for each such robot a flood, a grid search and a Traffic::LeastWait_s, or two of each; else
// O(robots).
std::vector<KeptWay> KeptWays(const Belief& belief, const RobotId& robot,
                              const PlanningOptions& options);

}  // namespace plumescout
