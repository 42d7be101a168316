// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/reward.h"

namespace plumescout {

double SampleTime_s(const Site& site, const RewardTerms& terms) {
  return site.travel_m / terms.speed_mps + terms.dwell_s;
}

double NormalisedConcentration(const Site& site, const RewardTerms& terms) {
  return terms.map_mean_ppm > 0.0 ? site.mean_ppm / terms.map_mean_ppm : 1.0;
}

double RewardOf(const Site& site, const RewardTerms& terms) {
  switch (terms.reward) {
    case SamplingReward::kVariance:
      return site.variance_ppm2;
    case SamplingReward::kVariancePerTime:
      return site.variance_ppm2 / SampleTime_s(site, terms);
    case SamplingReward::kConcentrationVariance:
      return NormalisedConcentration(site, terms) * site.variance_ppm2;
    case SamplingReward::kConcentrationPerTime:
      return NormalisedConcentration(site, terms) / SampleTime_s(site, terms);
    case SamplingReward::kConcentrationVariancePerTime:
      return NormalisedConcentration(site, terms) * site.variance_ppm2 / SampleTime_s(site, terms);
    case SamplingReward::kMean:
      return site.mean_ppm;
    case SamplingReward::kUcb:
      break;
  }
  return site.mean_ppm + terms.beta * site.variance_ppm2;
}

bool IsPerTime(SamplingReward reward) {
  return reward == SamplingReward::kVariancePerTime ||
         reward == SamplingReward::kConcentrationPerTime ||
         reward == SamplingReward::kConcentrationVariancePerTime;
}

}  // namespace plumescout
