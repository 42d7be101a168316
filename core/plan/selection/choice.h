// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/belief/belief.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/stop.h"

namespace plumescout {

// Chooses among plan.candidates by options.selection_rule, after pricing their expected information
// if it asks for that and until `stop` says so. The goal that the robot's live plan ends at is kept
// unless another is better by options.commitment_margin_share, so that robots do not turn round for
// little (ours). Pricing one candidate is not interrupted. Cost: that of ExpectedInformation::Of
// for each candidate, or nothing.
void Choose(const Belief& belief, const PlanningOptions& options, const StopFn& stop, Plan& plan);

}  // namespace plumescout
