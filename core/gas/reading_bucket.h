// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/gas/ageing.h"
#include "core/gas/information.h"

namespace plumescout {

// Readings of one site that age alike. The variance v_i of each grows by the same amount per time
// (see Ageing), so their differences stay while their ratios go to one: what is written below as of
// the newest of them holds for ever after.
struct ReadingBucket {
  std::int64_t count = 0;
  std::int64_t newest_ns = 0;  // when the newest was taken; the variances are as of then
  double least_variance_ppm2 = 0.0;
  double mean_variance_ppm2 = 0.0;  // of all v_i
  double most_variance_ppm2 = 0.0;
  double deviation_ppm = 0.0;  // sum of d_i = z_i - m_0
  double moment_ppm3 = 0.0;    // sum of d_i (v_i - mean)
};

// A bucket of one reading; `variance_ppm2` as from Ageing::InitialVariance_ppm2.
ReadingBucket BucketOf(std::int64_t taken_ns, double variance_ppm2, double deviation_ppm);

// The evidence of the bucket's readings as of `time_ns`, to second order in their differences: with
// V the mean variance then, count / V and (sum d_i - moment / V) / V. Exact for a single reading.
Evidence EvidenceOf(const ReadingBucket& bucket, const Ageing& ageing, std::int64_t time_ns);

// The most by which variances in a bucket may differ when it is made, as share of the least.
inline constexpr double kBucketSpread = 0.05;

// Merges buckets that are alike to kBucketSpread (e) as of `now_ns`, unless they hold readings
// newer than that. At all times from `now_ns` on
//   precision           is at most e^2 / 4 = 0.06 % too small: Kantorovich's inequality, which
//   bounds
//                       mean(v) mean(1/v) - 1 by (M - m)^2 / (4 M m) for v in [m, M];
//   weighted deviation  is at most e^2 sum lambda_i |d_i| off, 0.25 %: the remainder of Taylor's
//                       series is sum lambda_i d_i (v_i - V)^2 / V^2;
// at earlier times by as much more as the readings aged in between. Any two buckets that stay next
// to each other span more than e, so at most 2 ln(oldest / newest variance) / ln(1 + e) + 2 stay:
// a few hundred for a week at a half-life of two minutes. Cost: O(buckets log buckets).
void MergeAlike(std::int64_t now_ns, const Ageing& ageing, std::vector<ReadingBucket>& buckets);

}  // namespace plumescout
