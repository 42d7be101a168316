// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/mission_strategy.h"

#ifdef PLUMESCOUT_SERVER_OMPL
#include "ompl_planners/ompl_planner.h"
#endif

namespace plumescout::server {
namespace {

#ifdef PLUMESCOUT_SERVER_OMPL
const PathPlannerFactory kRivals = MakeOmplPlanner;
#else
const PathPlannerFactory kRivals = nullptr;
#endif

}  // namespace

bool HasRivals() { return kRivals != nullptr; }

absl::Status CheckRivals(bool are_on, bool has_rivals) {
  if (!are_on || has_rivals) return absl::OkStatus();
  return absl::InvalidArgumentError(
      "planning.rivals = true needs a server that is built with OMPL");
}

absl::StatusOr<std::unique_ptr<const Strategy>> MakeMissionStrategy(const PlanningOptions& options,
                                                                    Rivals rivals) {
  return MakeStrategy(options, rivals == Rivals::kOn ? kRivals : nullptr);
}

}  // namespace plumescout::server
