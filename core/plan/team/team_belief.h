// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "core/types/plan.h"

namespace plumescout {

// Beliefs as they would be if robots of a team had plans, or had none. Rasters are shared. Cost: a
// copy of the robots' records and the claims.

// With the plan as its robot's live one, begun now. REQUIRES: the belief has the robot.
Belief WithPlan(const Belief& belief, const Plan& plan);
// With these robots' plans ended. Who is unknown is passed over.
Belief WithoutPlans(const Belief& belief, const std::vector<RobotId>& robots);

// The robots that could do with a plan: they have a pose, are heard of, and follow no plan. In the
// order of ids.
std::vector<RobotId> FreeRobots(const Belief& belief);

}  // namespace plumescout
