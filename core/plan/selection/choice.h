// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/belief/belief.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/stop.h"

namespace plumescout {

// Chooses among plan.candidates by options.selection_rule, after pricing their expected information
// if it asks for that and until `stop` says so. Only those are priced that may be the best by what
// bounds their information; the others keep the bound, and the choice is as if all were priced. The
// goal that the robot's live plan ends at is kept unless another is better by
// options.commitment_margin_share, so that robots do not turn round for little (ours). Cost: that
// of ExpectedInformation::AtMost for each candidate and ::Of for some, or nothing.
void Choose(const Belief& belief, const PlanningOptions& options, const StopFn& stop, Plan& plan);

// Index of the candidate that the robot's live plan ends at, -1 if there is none.
int UnderWayTo(const std::vector<Candidate>& candidates, const Belief& belief,
               const RobotId& robot);

}  // namespace plumescout
