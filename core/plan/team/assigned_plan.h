// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/belief/belief.h"
#include "core/types/plan.h"
#include "core/types/plan_request.h"

namespace plumescout {

// A robot that stands farther than this from where its assigned plan begins plans anew.
inline constexpr double kAssignedStart_m = 0.5;

// The live plan that others ordered for the robot of the request, if it is what the robot asks for:
// it begins near where the robot is, or is to start, and leads home if the robot asks for that.
// None if it is so old that others do not reckon with it any more, or its way was closed since. The
// chosen candidate is there as far as the belief knows it, prices and rejected goals are not.
// Asked again it is the same, until the robot reports how it ended or has driven on. Changes
// nothing. Cost: O(cells of the way).
std::optional<Plan> AssignedPlan(const Belief& belief, const PlanRequest& request);

}  // namespace plumescout
