// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_bucket.h"

#include <algorithm>
#include <iterator>

namespace plumescout {
namespace {

using Moments = ReadingBucket::Moments;

// The same bucket, its variances as of `time_ns` >= newest_ns.
ReadingBucket AsOf(ReadingBucket bucket, const Ageing& ageing, std::int64_t time_ns) {
  bucket.least_variance_ppm2 =
      ageing.Variance_ppm2(bucket.least_variance_ppm2, bucket.newest_ns, time_ns);
  bucket.most_variance_ppm2 =
      ageing.Variance_ppm2(bucket.most_variance_ppm2, bucket.newest_ns, time_ns);
  bucket.newest_ns = time_ns;
  return bucket;
}

// Adds `from`, taken about a variance greater by `shift`: (x + shift)^k by the binomial theorem,
// Horner's rule for all k at once.
void AddShifted(const Moments& from, double shift, Moments& to) {
  Moments shifted = from;
  for (std::size_t row = 1; row < shifted.size(); ++row) {
    for (std::size_t k = shifted.size(); k-- > row;) shifted[k] += shift * shifted[k - 1];
  }
  for (std::size_t k = 0; k < to.size(); ++k) to[k] += shifted[k];
}

ReadingBucket Merged(const ReadingBucket& first, const ReadingBucket& second,
                     const Ageing& ageing) {
  const std::int64_t newest_ns = std::max(first.newest_ns, second.newest_ns);
  const ReadingBucket a = AsOf(first, ageing, newest_ns);
  const ReadingBucket b = AsOf(second, ageing, newest_ns);
  ReadingBucket merged;
  merged.newest_ns = newest_ns;
  merged.least_variance_ppm2 = std::min(a.least_variance_ppm2, b.least_variance_ppm2);
  merged.most_variance_ppm2 = std::max(a.most_variance_ppm2, b.most_variance_ppm2);
  for (const ReadingBucket& part : {a, b}) {
    const double shift = part.middle_variance_ppm2() - merged.middle_variance_ppm2();
    AddShifted(part.count_moments, shift, merged.count_moments);
    AddShifted(part.deviation_moments, shift, merged.deviation_moments);
    AddShifted(part.square_moments, shift, merged.square_moments);
  }
  return merged;
}

// The sum of m_k (-1)^k / v^(k+1).
double SumOfSeries(const Moments& moments, double precision) {
  double sum = 0.0;
  for (std::size_t k = moments.size(); k-- > 0;) sum = moments[k] - precision * sum;
  return precision * sum;
}

}  // namespace

ReadingBucket BucketOf(std::int64_t taken_ns, double variance_ppm2, double deviation_ppm) {
  return {.newest_ns = taken_ns,
          .least_variance_ppm2 = variance_ppm2,
          .most_variance_ppm2 = variance_ppm2,
          .count_moments = {1.0},
          .deviation_moments = {deviation_ppm},
          .square_moments = {deviation_ppm * deviation_ppm}};
}

Evidence EvidenceOf(const ReadingBucket& bucket, const Ageing& ageing, std::int64_t time_ns) {
  const double precision =
      ageing.Precision(bucket.middle_variance_ppm2(), bucket.newest_ns, time_ns);
  return {SumOfSeries(bucket.count_moments, precision),
          SumOfSeries(bucket.deviation_moments, precision),
          SumOfSeries(bucket.square_moments, precision), bucket.count_moments[0]};
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
