// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_bucket.h"

#include <algorithm>
#include <iterator>

namespace plumescout {
namespace {

// The same bucket, its variances as of `time_ns` >= newest_ns.
ReadingBucket AsOf(ReadingBucket bucket, const Ageing& ageing, std::int64_t time_ns) {
  const auto aged = [&](double variance_ppm2) {
    return ageing.Variance_ppm2(variance_ppm2, bucket.newest_ns, time_ns);
  };
  bucket.least_variance_ppm2 = aged(bucket.least_variance_ppm2);
  bucket.mean_variance_ppm2 = aged(bucket.mean_variance_ppm2);
  bucket.most_variance_ppm2 = aged(bucket.most_variance_ppm2);
  bucket.newest_ns = time_ns;
  return bucket;
}

double MomentAbout(const ReadingBucket& bucket, double variance_ppm2) {
  return bucket.moment_ppm3 + bucket.deviation_ppm * (bucket.mean_variance_ppm2 - variance_ppm2);
}

ReadingBucket Merged(const ReadingBucket& first, const ReadingBucket& second,
                     const Ageing& ageing) {
  const std::int64_t newest_ns = std::max(first.newest_ns, second.newest_ns);
  const ReadingBucket a = AsOf(first, ageing, newest_ns);
  const ReadingBucket b = AsOf(second, ageing, newest_ns);
  ReadingBucket merged;
  merged.count = a.count + b.count;
  merged.newest_ns = newest_ns;
  merged.least_variance_ppm2 = std::min(a.least_variance_ppm2, b.least_variance_ppm2);
  merged.mean_variance_ppm2 = a.mean_variance_ppm2 + (b.mean_variance_ppm2 - a.mean_variance_ppm2) *
                                                         static_cast<double>(b.count) /
                                                         static_cast<double>(merged.count);
  merged.most_variance_ppm2 = std::max(a.most_variance_ppm2, b.most_variance_ppm2);
  merged.deviation_ppm = a.deviation_ppm + b.deviation_ppm;
  merged.moment_ppm3 =
      MomentAbout(a, merged.mean_variance_ppm2) + MomentAbout(b, merged.mean_variance_ppm2);
  return merged;
}

}  // namespace

ReadingBucket BucketOf(std::int64_t taken_ns, double variance_ppm2, double deviation_ppm) {
  return {.count = 1,
          .newest_ns = taken_ns,
          .least_variance_ppm2 = variance_ppm2,
          .mean_variance_ppm2 = variance_ppm2,
          .most_variance_ppm2 = variance_ppm2,
          .deviation_ppm = deviation_ppm};
}

Evidence EvidenceOf(const ReadingBucket& bucket, const Ageing& ageing, std::int64_t time_ns) {
  const double variance_ppm2 =
      ageing.Variance_ppm2(bucket.mean_variance_ppm2, bucket.newest_ns, time_ns);
  return {static_cast<double>(bucket.count) / variance_ppm2,
          (bucket.deviation_ppm - bucket.moment_ppm3 / variance_ppm2) / variance_ppm2};
}

void MergeAlike(std::int64_t now_ns, const Ageing& ageing, std::vector<ReadingBucket>& buckets) {
  if (buckets.size() < 2) return;
  const auto newer = std::stable_partition(
      buckets.begin(), buckets.end(),
      [&](const ReadingBucket& bucket) { return bucket.newest_ns <= now_ns; });
  const auto least_ppm2 = [&](const ReadingBucket& bucket) {
    return ageing.Variance_ppm2(bucket.least_variance_ppm2, bucket.newest_ns, now_ns);
  };
  const auto most_ppm2 = [&](const ReadingBucket& bucket) {
    return ageing.Variance_ppm2(bucket.most_variance_ppm2, bucket.newest_ns, now_ns);
  };
  // Sorted so, a merged bucket ends before the next begins, now and for ever: the bound on their
  // number rests on that.
  std::stable_sort(buckets.begin(), newer, [&](const ReadingBucket& a, const ReadingBucket& b) {
    return least_ppm2(a) < least_ppm2(b);
  });
  auto end = buckets.begin();  // of the merged ones
  for (auto bucket = end; bucket != newer; ++bucket) {
    if (end != buckets.begin()) {
      ReadingBucket& last = *std::prev(end);
      const double most = std::max(most_ppm2(last), most_ppm2(*bucket));
      if (most <= (1.0 + kBucketSpread) * least_ppm2(last)) {
        last = Merged(last, *bucket, ageing);
        continue;
      }
    }
    *end++ = *bucket;
  }
  buckets.erase(end, newer);
  buckets.shrink_to_fit();
}

}  // namespace plumescout
