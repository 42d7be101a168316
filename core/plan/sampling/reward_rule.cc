// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/plan/sampling/sampling_rule.h"

namespace plumescout {
namespace {

const char* NameOf(SamplingReward reward) {
  switch (reward) {
    case SamplingReward::kVariance:
      return "variance";
    case SamplingReward::kVariancePerTime:
      return "variance per second";
    case SamplingReward::kConcentrationVariance:
      return "normalised concentration times variance";
    case SamplingReward::kConcentrationPerTime:
      return "normalised concentration per second";
    case SamplingReward::kConcentrationVariancePerTime:
      return "normalised concentration times variance per second";
    case SamplingReward::kMean:
      return "concentration";
    case SamplingReward::kUcb:
      break;
  }
  return "upper confidence bound";
}

// [IPP] section III: with V / C alone "no location shall be visited twice". And no robot stays
// where sampling takes no time, for it would stay for ever.
bool IsEligible(const Site& site, const RewardTerms& terms) {
  if (terms.reward == SamplingReward::kConcentrationPerTime && site.sampled) return false;
  return SampleTime_s(site, terms) > 0.0;
}

class RewardRule : public SamplingRule {
 public:
  absl::StatusOr<SamplingChoice> Choose(const SamplingQuery& query) const override {
    const RewardTerms terms = TermsOf(query);
    SamplingChoice choice;
    for (const Site& site : query.sites.offered) {
      if (IsEligible(site, terms)) choice.errands.push_back({{site}, RewardOf(site, terms)});
    }
    choice.errands = BestFirst(std::move(choice.errands), query.robot.options.max_goal_count);
    if (!choice.errands.empty()) {
      choice.merit =
          absl::StrFormat("greatest %s, %.4g", NameOf(terms.reward), choice.errands.front().reward);
    }
    return choice;
  }
};

}  // namespace

std::vector<Errand> BestFirst(std::vector<Errand> errands, int count) {
  const auto kept = std::min(errands.size(), static_cast<std::size_t>(count));
  std::partial_sort(errands.begin(), errands.begin() + static_cast<std::ptrdiff_t>(kept),
                    errands.end(), [](const Errand& a, const Errand& b) {
                      return a.reward != b.reward ? a.reward > b.reward
                                                  : a.stops[0].index < b.stops[0].index;
                    });
  errands.resize(kept);
  return errands;
}

RewardTerms TermsOf(const SamplingQuery& query) {
  const PlanningOptions& options = query.robot.options;
  return {options.sites.reward, options.beta, options.speed_mps, options.dwell_s,
          query.sites.map_mean_ppm};
}

std::unique_ptr<const SamplingRule> MakeRewardRule() { return std::make_unique<RewardRule>(); }

}  // namespace plumescout
