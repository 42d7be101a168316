// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/belief/belief.h"
#include "core/plan/paths/path_planners.h"
#include "core/types/options.h"
#include "core/types/plan.h"
#include "core/types/plan_request.h"
#include "core/types/stop.h"

namespace plumescout {

// Told of every better plan on the way to the final one.
using PlanListener = std::function<void(const Plan&)>;

// A planner of missions: three small choices - where to go (goals), how to get there (paths),
// which to take (selection). Immutable; Plan is const and may run on many threads at once.
class Strategy {
 public:
  virtual ~Strategy() = default;

  // The next best trajectory for the robot of `request` on `belief`. Same belief, request and
  // options: the same bytes, unless `stop` says so. "No goal" and "mission complete" are plans,
  // not errors.
  //
  // Errors: kNotFound if the robot is unknown; kFailedPrecondition if it has no pose yet;
  // kInvalidArgument if the start is not finite or outside the map; kDeadlineExceeded if `stop`
  // came before any path was found.
  //
  // `improved`, if not null, is told of each better plan that an anytime search has on the way;
  // other searches have none. The cost of no candidate is above that of an earlier plan, provided
  // that the selection cost is that of the search and that it need not lead round other robots
  // (core/plan/way_round.h). Goals without a path so far are kSearchStopped.
  // Expected information is not priced: the choice is by cost where the rule asks for it.
  virtual absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                                const StopFn& stop,
                                                const PlanListener& improved) const = 0;
  absl::StatusOr<plumescout::Plan> Plan(const Belief& belief, const PlanRequest& request,
                                        const StopFn& stop) const {
    return Plan(belief, request, stop, nullptr);
  }
};

// Names of the rows: "xit_gff", "xit_fgf", "xit_f", "mit", "rrt_star_frontier", "plumescout", and
// those that stop at sites and sample: "ipp_reward", "lhr", "random_sampling", "sweep".
std::vector<std::string> StrategyNames();

// Whether the row of this name has robots stop at sites and sample.
bool StopsAtSites(const std::string& strategy);

// Sets the parts of `options` that the row `options.strategy` fixes (goals, cost, ...). That does
// not make the search of "xit_..." and "mit" the published one: what we add to it, such as the
// limit of the connection radius, is left as it is, and whoever compares with the papers turns it
// off (lab/trials/trial_study.h, MakePublishedRow). kInvalidArgument for an unknown name.
absl::Status ApplyStrategyRow(PlanningOptions& options);

// Whether the strategy never has a site sampled twice.
bool SamplesOnce(const PlanningOptions& options);

// Builds the strategy that `options` describe; `others` makes path planners that core does not
// have. kInvalidArgument if the options are invalid, or not what the strategy needs, or no such
// planner is to be had.
absl::StatusOr<std::unique_ptr<const Strategy>> MakeStrategy(
    const PlanningOptions& options, const PathPlannerFactory& others = nullptr);

// The same, with this planner in the place of the one that options.paths names.
absl::StatusOr<std::unique_ptr<const Strategy>> MakeStrategyWith(
    const PlanningOptions& options, std::unique_ptr<const PathPlanner> paths);

}  // namespace plumescout
