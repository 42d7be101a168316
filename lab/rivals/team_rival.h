// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "core/plan/strategy.h"
#include "core/types/options.h"

namespace plumescout::lab {

// Which rule of team_rules.h chooses.
enum class TeamRule { kBurgard, kMatching, kRrtExploration };

// "burgard", "matching", "rrt_exploration".
std::string NameOf(TeamRule rule);

// Plans by `frontiers`, a strategy of these options whose only goals are frontiers while there are
// any, and lets the rule choose among its candidates then. What no rule is about stays: ways keep
// clear of other robots by waiting, whoever stands in the way makes room, and nobody gets a goal
// within kClaimRadius_m of another's.
std::unique_ptr<const Strategy> MakeTeamRival(TeamRule rule, const PlanningOptions& options,
                                              std::unique_ptr<const Strategy> frontiers);

}  // namespace plumescout::lab
