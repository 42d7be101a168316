// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/gas/ageing.h"
#include "core/gas/information.h"

namespace plumescout {

// Readings that age alike. The variance v_i of each grows by the same amount per time (see Ageing),
// so their differences stay while their ratios go to one. Hence the sum of 1 / v_i is kept as a
// series about the middle variance v, which converges the better the older the readings are:
//   1 / v_i = sum over k of (-1)^k (v_i - v)^k / v^(k+1).
struct ReadingBucket {
  static constexpr std::size_t kTerms = 5;
  using Moments = std::array<double, kTerms>;

  std::int64_t newest_ns = 0;  // when the newest was taken; the variances are as of then
  double least_variance_ppm2 = 0.0;
  double most_variance_ppm2 = 0.0;
  Moments count_moments{};      // sums of (v_i - v)^k
  Moments deviation_moments{};  // sums of d_i (v_i - v)^k, with d_i = z_i - m_0
  Moments square_moments{};     // sums of d_i^2 (v_i - v)^k

  double middle_variance_ppm2() const { return 0.5 * (least_variance_ppm2 + most_variance_ppm2); }
};

// A bucket of one reading; `variance_ppm2` as from Ageing::InitialVariance_ppm2.
ReadingBucket BucketOf(std::int64_t taken_ns, double variance_ppm2, double deviation_ppm);

// The evidence of the bucket's readings as of `time_ns`; exact for a single reading.
Evidence EvidenceOf(const ReadingBucket& bucket, const Ageing& ageing, std::int64_t time_ns);

// The most by which variances in a bucket may differ when it is made, as share of the least.
inline constexpr double kBucketSpread = 0.5;
// The share by which the precision of any one reading in it may then be off: the remainder of the
// series after kTerms terms is ((v - v_i) / v)^kTerms, and |v_i - v| / v <= s / (2 + s) = 0.2 for a
// spread s. Well below the hundredth by which precisions may be stale between two ageings.
inline constexpr double kBucketError = 0.2 * 0.2 * 0.2 * 0.2 * 0.2;  // 0.032 %

// Merges buckets that are alike to kBucketSpread as of `now_ns`, unless they hold readings newer
// than that. At all times from `now_ns` on no reading's part in a sum is off by more than
// kBucketError; at earlier times by as much more as the readings aged in between. Any two buckets
// that stay next to each other differ by more than kBucketSpread, so at most
//   2 ln(greatest / least variance) / ln(1 + kBucketSpread) + 2
// stay: 44 for a week at a half-life of two minutes. Cost: O(buckets log buckets).
void MergeAlike(std::int64_t now_ns, const Ageing& ageing, std::vector<ReadingBucket>& buckets);

}  // namespace plumescout
