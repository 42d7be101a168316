// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/plan/goals/goal_offer.h"
#include "core/plan/sampling/reward.h"
#include "core/plan/sampling/sites.h"
#include "core/types/options.h"
#include "core/types/stop.h"

namespace plumescout {

// For whom sites are chosen. Holds references: for the length of one call.
struct SamplingQuery {
  const GoalQuery& robot;
  Point2 start;  // where it departs from, in a reachable cell
  const Sites& sites;
  std::uint64_t seed = 0;
  const StopFn& stop;
};

// Sites to sample one after the other.
struct Errand {
  std::vector<Site> stops;  // in order, at least one
  double reward = 0.0;
};

// What a rule would have the robot do; without an errand there is nothing left to sample.
struct SamplingChoice {
  MissionPhase phase = MissionPhase::kSampling;
  std::vector<Errand> errands;  // the chosen one first
  std::string merit;            // why it was chosen: "greatest sigma^2 / C, 0.12"
};

// Which sites a robot samples next. Immutable; Choose may run on many threads at once, and is
// deterministic.
class SamplingRule {
 public:
  virtual ~SamplingRule() = default;
  // Errors: kDeadlineExceeded if stopped, kInternal from a solver.
  virtual absl::StatusOr<SamplingChoice> Choose(const SamplingQuery& query) const = 0;
};

// The `count` errands with the greatest rewards, best first; of equal ones the one whose first stop
// comes first in the lattice. All if there are fewer. Cost: O(errands log count).
std::vector<Errand> BestFirst(std::vector<Errand> errands, int count);

// The terms by which the query's sites are judged.
RewardTerms TermsOf(const SamplingQuery& query);

// The next best site by the reward, [IPP] Eq. (8)-(13), which kMean and kUcb extend; up to
// max_goal_count errands.
std::unique_ptr<const SamplingRule> MakeRewardRule();

// [LHR] Algorithm 1; `at_random` draws the rewards of its cycles: constrained random sampling,
// section IV-B.
std::unique_ptr<const SamplingRule> MakeLowToHighRule(bool at_random);

// The next site of a lawnmower sweep that has not been sampled; it begins at the corner of the
// region nearest to where the robot was first, with legs along x.
std::unique_ptr<const SamplingRule> MakeSweepRule();

}  // namespace plumescout
