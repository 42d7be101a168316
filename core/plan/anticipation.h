// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/belief/belief.h"
#include "core/gas/gas_what_if.h"
#include "core/types/options.h"
#include "core/types/stop.h"

namespace plumescout {

// Readings that the other robots of a mission are about to take on what is left of their live
// plans, as cells of the belief's map. A promise far ahead, or of a robot that has fallen behind
// its plan, has less precision: the full one for 10 s, then e times less every 20 s. Who is silent,
// has strayed or is long overdue promises nothing. At most kMostPromised, and fewer on a map of
// more than 100,000 cells, where each costs more: neighbours on one way are put together in the
// middle of them, with the sum of their precisions. Cost: O(readings).
inline constexpr std::size_t kMostPromised = 64;
std::vector<ForeseenCell> PromisedReadings(const Belief& belief, const RobotId& robot,
                                           const PlanningOptions& options);

// The belief with its gas field as sure as it is to be once those readings have been taken: what a
// way of the robot's own tells is then what it tells besides, I(own and others) - I(others), and
// what others will have observed is no goal. Chosen one after the other like this, the ways of k
// robots tell at least half of the most that ways from the same lists of candidates could, for the
// sum of relevance * 1/2 ln(variance) is monotone and submodular: H is an M-matrix, so that to know
// more never raises a correlation. Not so once value is divided by time, as our choice does.
// Means, and all else, are those of now. None if nothing is promised, or there is no gas
// field, or once `stop`, which is asked all along, says so. Cost: that of GasWhatIf::Given, and
// O(cells).
std::optional<Belief> Anticipate(const Belief& belief, const RobotId& robot,
                                 const PlanningOptions& options, const StopFn& stop = {});

}  // namespace plumescout
