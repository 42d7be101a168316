// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/choice.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/plan/selection/expected_information.h"
#include "core/plan/selection/selection.h"

namespace plumescout {
namespace {

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

// Prices the expected information of candidates one by one, those that may be worth most first,
// until no other can be the best.
class Pricing {
 public:
  Pricing(const Belief& belief, const PlanningOptions& options, const StopFn& stop,
          std::vector<Candidate>& candidates)
      : belief_(belief),
        options_(options),
        stop_(stop),
        candidates_(candidates),
        information_(belief, stop) {}

  // `needed`: index of one whose price is wanted whatever the others are worth; -1: there is none.
  void Run(int needed) {
    if (candidates_.size() == 1) needed = 0;  // there is nothing to compare it with
    if (needed >= 0 && !Price(candidates_[static_cast<std::size_t>(needed)])) return;
    for (Candidate* const candidate : MostPromisingFirst()) {
      if (candidate->expected_information_nats) continue;
      const double most = InformationRate(*candidate, *candidate->information_bound_nats, options_);
      if (most < best_ || !Price(*candidate)) return;
    }
  }

 private:
  std::vector<Cell> Readings(const Candidate& candidate) const {
    return ReadingCells(candidate.path, belief_.geometry(), options_);
  }

  // Those that have a bound.
  std::vector<Candidate*> MostPromisingFirst() {
    std::vector<Candidate*> order;
    if (candidates_.size() > 1) information_.FindBounds(stop_);
    for (Candidate& candidate : candidates_) {
      if (stop_()) break;
      if (candidate.expected_information_nats) continue;
      candidate.information_bound_nats = information_.AtMost(Readings(candidate), stop_);
      if (candidate.information_bound_nats) order.push_back(&candidate);
    }
    std::stable_sort(order.begin(), order.end(), [&](const Candidate* a, const Candidate* b) {
      return InformationRate(*a, *a->information_bound_nats, options_) >
             InformationRate(*b, *b->information_bound_nats, options_);
    });
    return order;
  }

  // Returns whether it was possible, and there is time for more.
  bool Price(Candidate& candidate) {
    if (stop_()) return false;
    candidate.expected_information_nats = information_.Of(Readings(candidate), stop_);
    if (!candidate.expected_information_nats) return false;
    candidate.information_bound_nats.reset();
    best_ =
        std::max(best_, InformationRate(candidate, *candidate.expected_information_nats, options_));
    return true;
  }

  const Belief& belief_;
  const PlanningOptions& options_;
  const StopFn& stop_;
  std::vector<Candidate>& candidates_;
  ExpectedInformation information_;
  double best_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

int UnderWayTo(const std::vector<Candidate>& candidates, const Belief& belief,
               const RobotId& robot) {
  for (const GoalClaim& claim : belief.claims) {
    if (claim.robot == robot && claim.expires_ns > belief.sample_time_ns) {
      return NearestCovered(claim.goal, candidates);
    }
  }
  return -1;
}

void Choose(const Belief& belief, const PlanningOptions& options, const StopFn& stop, Plan& plan) {
  std::vector<Candidate>& candidates = plan.candidates;
  const bool commits = options.commitment_margin_share != 0.0;
  const int kept = commits ? UnderWayTo(candidates, belief, plan.robot) : -1;
  if (options.selection_rule == SelectionRule::kInformationRate && !candidates.empty()) {
    Pricing(belief, options, stop, candidates).Run(kept);
  }
  plan.chosen = SelectCandidate(candidates, options);
  if (kept < 0 || kept == plan.chosen) return;
  const Candidate& best = candidates[static_cast<std::size_t>(plan.chosen)];
  if (BeatsByMargin(best, candidates[static_cast<std::size_t>(kept)], options)) {
    return;
  }
  plan.chosen = kept;
  plan.goal_kept = true;
}

}  // namespace plumescout
