// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/mission/mission.h"
#include "core/plan/cost/information_map.h"
#include "core/plan/paths/path_planner.h"
#include "core/types/ids.h"
#include "core/types/plan.h"

namespace plumescout::lab {

struct PlanningStepOptions {
  RobotId robot;           // empty: the first by name
  std::string strategy;    // row of the strategy table; empty: the mission's own options
  std::uint64_t seed = 0;  // 0: that of the mission's next plan
};

// One planning step, with what a plan does not say: what it was made from.
struct PlanningStep {
  std::shared_ptr<const Belief> belief;
  InformationMap information;
  std::vector<TreeEdge> tree;  // empty if the planner grows none of ours
  Plan plan;  // every candidate with its expected information, if there is a gas field
};

// Plans the next trajectory without committing it, and without a deadline. With nothing else asked
// for, at the revision on which a plan was made this is that plan. Brings the posterior up to date
// first, as whoever plans for robots does. Errors: kNotFound if there is no such robot; those of
// MakeStrategy and Strategy::Plan.
absl::StatusOr<PlanningStep> TakePlanningStep(Mission& mission, const PlanningStepOptions& options);

}  // namespace plumescout::lab
