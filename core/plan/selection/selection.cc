// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/selection.h"

#include <algorithm>
#include <cmath>

namespace plumescout {

namespace {

constexpr double kLeast_s = 1e-3;  // a candidate takes this long at least

// Twice what a reading in open air that nobody has read tells of its own cell, nats.
double ToldByReading_nats(const GasOptions& gas) {
  return std::log1p(gas.observation_precision_per_ppm2 *
                    std::max(0.0, OpenLatticeVariance_ppm2(gas)));
}

double WorthOf_nats(const Candidate& candidate, double nats, const PlanningOptions& options) {
  return nats + (EndsAtTheUnseen(candidate)
                     ? candidate.unseen_share * options.unseen_information_nats
                     : 0.0);
}

// What the rule wants most of; the rest of `options` says how information counts.
double Merit(const Candidate& candidate, SelectionRule rule, const PlanningOptions& options) {
  switch (rule) {
    case SelectionRule::kLeastCost:
      break;
    case SelectionRule::kMeanUcb:
      return candidate.mean_ucb;
    case SelectionRule::kInformationRate:
      if (!candidate.expected_information_nats) return -1.0;  // below any that is priced
      return InformationRate(candidate, *candidate.expected_information_nats, options);
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

bool EndsAtTheUnseen(const Candidate& candidate) {
  return candidate.goal.kind == GoalKind::kOccupancyFrontier;
}

PlanningOptions InField(PlanningOptions options, const GasOptions& gas) {
  options.unseen_information_nats *=
      ToldByReading_nats(gas) / ToldByReading_nats(PublishedGasOptions());
  return options;
}

double Worth_nats(const Candidate& candidate, const PlanningOptions& options) {
  return WorthOf_nats(candidate, *candidate.expected_information_nats, options);
}

double InformationRate(const Candidate& candidate, double nats, const PlanningOptions& options) {
  return WorthOf_nats(candidate, nats, options) / std::max(candidate.duration_s, kLeast_s);
}

int SelectCandidate(const std::vector<Candidate>& candidates, const PlanningOptions& options) {
  if (candidates.empty()) return -1;
  const SelectionRule rule = Applicable(candidates, options.selection_rule);
  const auto better = [&](const Candidate& a, const Candidate& b) {
    return Merit(a, rule, options) > Merit(b, rule, options);
  };
  return static_cast<int>(std::min_element(candidates.begin(), candidates.end(), better) -
                          candidates.begin());
}

bool BeatsByMargin(const Candidate& best, const Candidate& kept, const PlanningOptions& options) {
  const SelectionRule rule = Applicable({best, kept}, options.selection_rule);
  const double needed = Merit(kept, rule, options);
  return Merit(best, rule, options) > needed + options.commitment_margin_share * std::abs(needed);
}

}  // namespace plumescout
