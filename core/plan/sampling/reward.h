// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/sampling/sites.h"
#include "core/types/options.h"

namespace plumescout {

// What a site is judged by, beside itself.
struct RewardTerms {
  SamplingReward reward;
  double beta = 1.0;          // of kUcb
  double speed_mps = 1.0;     // v_r of [IPP] Eq. (7)
  double dwell_s = 0.0;       // t_sample there
  double map_mean_ppm = 0.0;  // of [IPP] Eq. (10), above the background
};

// C of [IPP] Eq. (7): the time to drive to a site and sample it, seconds.
double SampleTime_s(const Site& site, const RewardTerms& terms);

// V of [IPP] Eq. (10). 1 while the map holds no gas, where Eq. (10) is 0/0, or has a mean below the
// background, which would turn the order of the sites round (ours).
double NormalisedConcentration(const Site& site, const RewardTerms& terms);

// The reward of the site. REQUIRES: SampleTime_s > 0 for rewards per time.
double RewardOf(const Site& site, const RewardTerms& terms);

// Whether the reward is per time: then it belongs to the next stop alone, for sums of it mean
// nothing.
bool IsPerTime(SamplingReward reward);

}  // namespace plumescout
