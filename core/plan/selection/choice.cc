// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/choice.h"

#include <cstddef>
#include <limits>
#include <vector>

#include "core/plan/selection/expected_information.h"
#include "core/plan/selection/selection.h"

namespace plumescout {
namespace {

void PriceInformation(const Belief& belief, const PlanningOptions& options, const StopFn& stop,
                      std::vector<Candidate>& candidates) {
  const ExpectedInformation information(belief);
  for (Candidate& candidate : candidates) {
    if (stop()) return;
    candidate.expected_information_nats =
        information.Of(ReadingCells(candidate.path, belief.geometry(), options));
  }
}

// Index of the candidate at `claimed` or nearest to it, -1 if it covers none.
int NearestCovered(const Goal& claimed, const std::vector<Candidate>& candidates) {
  int nearest = -1;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double distance_m = Distance_m(claimed.position, candidates[i].goal.position);
    if (!ClaimCovers(claimed, candidates[i].goal) || distance_m >= nearest_m) continue;
    nearest = static_cast<int>(i);
    nearest_m = distance_m;
  }
  return nearest;
}

// Index of the candidate that the robot's live plan ends at, -1 if there is none.
int UnderWayTo(const std::vector<Candidate>& candidates, const Belief& belief,
               const RobotId& robot) {
  for (const GoalClaim& claim : belief.claims) {
    if (claim.robot == robot && claim.expires_ns > belief.sample_time_ns) {
      return NearestCovered(claim.goal, candidates);
    }
  }
  return -1;
}

}  // namespace

void Choose(const Belief& belief, const PlanningOptions& options, const StopFn& stop, Plan& plan) {
  std::vector<Candidate>& candidates = plan.candidates;
  if (options.selection_rule == SelectionRule::kInformationRate) {
    PriceInformation(belief, options, stop, candidates);
  }
  plan.chosen = SelectCandidate(candidates, options.selection_rule);
  const int kept = UnderWayTo(candidates, belief, plan.robot);
  if (kept < 0 || kept == plan.chosen || options.commitment_margin_share == 0.0) return;
  const Candidate& best = candidates[static_cast<std::size_t>(plan.chosen)];
  if (BeatsByMargin(best, candidates[static_cast<std::size_t>(kept)], options.selection_rule,
                    options.commitment_margin_share)) {
    return;
  }
  plan.chosen = kept;
  plan.goal_kept = true;
}

}  // namespace plumescout
