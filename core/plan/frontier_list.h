// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/plan/goals/frontier_goals.h"
#include "core/types/ids.h"
#include "core/types/options.h"

namespace plumescout {

// Every frontier as a goal of one robot, from where its next plan would start: what planning
// offers, before the limit of goals, and what it leaves out with the reason. A robot without a way
// out of where it stands can reach none.
//
// Errors: kNotFound if the robot is unknown; kFailedPrecondition if it has no pose or stands off
// the map (START_OUTSIDE_MAP). Cost: O(cells).
absl::StatusOr<std::vector<JudgedFrontier>> ListFrontiers(const Belief& belief,
                                                          const RobotId& robot,
                                                          const PlanningOptions& options);

}  // namespace plumescout
