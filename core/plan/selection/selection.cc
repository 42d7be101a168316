// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/selection.h"

#include <algorithm>
#include <cmath>

namespace plumescout {

namespace {

constexpr double kLeast_s = 1e-3;  // a candidate takes this long at least

// What the rule wants most of.
double Merit(const Candidate& candidate, SelectionRule rule) {
  switch (rule) {
    case SelectionRule::kLeastCost:
      break;
    case SelectionRule::kMeanUcb:
      return candidate.mean_ucb;
    case SelectionRule::kInformationRate:
      if (!candidate.expected_information_nats) return -1.0;  // below any that is priced
      return Worth_nats(candidate) / std::max(candidate.duration_s, kLeast_s);
  }
  return -candidate.cost;
}

SelectionRule Applicable(const std::vector<Candidate>& candidates, SelectionRule rule) {
  const bool none_is_priced = std::none_of(
      candidates.begin(), candidates.end(),
      [](const Candidate& candidate) { return candidate.expected_information_nats.has_value(); });
  const bool asks = rule == SelectionRule::kInformationRate;
  return asks && none_is_priced ? SelectionRule::kLeastCost : rule;
}

}  // namespace

double Worth_nats(const Candidate& candidate) {
  const bool unseen = candidate.goal.kind == GoalKind::kOccupancyFrontier;
  return *candidate.expected_information_nats + (unseen ? kUnseen_nats : 0.0);
}

int SelectCandidate(const std::vector<Candidate>& candidates, SelectionRule rule) {
  if (candidates.empty()) return -1;
  const SelectionRule applicable = Applicable(candidates, rule);
  const auto better = [applicable](const Candidate& a, const Candidate& b) {
    return Merit(a, applicable) > Merit(b, applicable);
  };
  return static_cast<int>(std::min_element(candidates.begin(), candidates.end(), better) -
                          candidates.begin());
}

bool BeatsByMargin(const Candidate& best, const Candidate& kept, SelectionRule rule,
                   double margin) {
  const SelectionRule applicable = Applicable({best, kept}, rule);
  const double needed = Merit(kept, applicable);
  return Merit(best, applicable) > needed + margin * std::abs(needed);
}

}  // namespace plumescout
