// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/types/rectangle.h"

namespace plumescout {

// What a place is worth sampling for, from its mean mu, its variance and the time C to drive there
// and sample, [IPP] Eq. (7); V is mu over the mean of the map, both above the background, Eq. (10).
enum class SamplingReward {
  kVariance,                      // sigma^2, Eq. (8)
  kVariancePerTime,               // sigma^2 / C, Eq. (9)
  kConcentrationVariance,         // V sigma^2, Eq. (11)
  kConcentrationPerTime,          // V / C, Eq. (12); no place twice
  kConcentrationVariancePerTime,  // V sigma^2 / C, Eq. (13)
  kMean,                          // mu, [LHR] section IV
  kUcb,                           // mu + beta sigma^2, [LHR] section IV
};

// Sites: the places on a square lattice where the strategies lhr, ipp_reward, random_sampling and
// sweep have robots stop for dwell_s and sample. One lies in the middle of each square of
// spacing_m.
struct SiteOptions {
  // What is sampled; whole multiples of spacing_m wide and high. None: all of the map, which the
  // strategies that make a tour do not take.
  std::optional<Rectangle> region;
  double spacing_m = 1.0;  // d_res of [LHR], [0.05, 1000]
  SamplingReward reward = SamplingReward::kUcb;
  // lhr and random_sampling: every survey_stride-th site first; the last row and column are among
  // them.
  bool survey = true;
  int survey_stride = 10;  // alpha of [LHR], [1, 1000]
  // lhr and random_sampling: update cycles of cycle_sample_count sites, of the candidate_count
  // best, that are reached and sampled within update_period_s; [LHR] (P2).
  int candidate_count = 15;       // M, [1, 16]
  int cycle_sample_count = 10;    // T, [1, M]
  double update_period_s = 50.0;  // t_up, [0.001, 1e6]
  // sweep: every sweep_stride-th site of every sweep_leg_stride-th row.
  int sweep_stride = 1;      // [1, 1000]
  int sweep_leg_stride = 1;  // [1, 1000]
};

}  // namespace plumescout
