// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_bucket.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/types/rng.h"

namespace plumescout {
namespace reading_bucket_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kHalfLife_s = 120.0;
constexpr double kDefaultVariance_ppm2 = 0.1;

Ageing HalfLife(double half_life_s = kHalfLife_s) {
  GasOptions options;
  options.observation_precision_per_ppm2 = 1.0 / kDefaultVariance_ppm2;
  options.ageing_half_life_s = half_life_s;
  return Ageing(options);
}

// One reading as it was taken, and what it says, straight from the definition of ageing.
struct RawReading {
  std::int64_t taken_ns;
  double variance_ppm2;
  double deviation_ppm;
};

struct RawSum {
  double precision = 0.0;
  double weighted_deviation = 0.0;
  double weighted_magnitude = 0.0;  // sum of lambda_i |d_i|
};

RawSum Sum(const std::vector<RawReading>& readings, std::int64_t time_ns) {
  RawSum sum;
  for (const RawReading& r : readings) {
    const double age_s = std::max(0.0, static_cast<double>(time_ns - r.taken_ns) * 1e-9);
    const double precision = 1.0 / (r.variance_ppm2 + age_s / kHalfLife_s * kDefaultVariance_ppm2);
    sum.precision += precision;
    sum.weighted_deviation += precision * r.deviation_ppm;
    sum.weighted_magnitude += precision * std::abs(r.deviation_ppm);
  }
  return sum;
}

Evidence Sum(const std::vector<ReadingBucket>& buckets, std::int64_t time_ns) {
  Evidence evidence;
  for (const ReadingBucket& b : buckets) evidence += EvidenceOf(b, HalfLife(), time_ns);
  return evidence;
}

std::vector<ReadingBucket> Buckets(const std::vector<RawReading>& readings) {
  std::vector<ReadingBucket> buckets;
  for (const RawReading& r : readings) {
    buckets.push_back(BucketOf(r.taken_ns, r.variance_ppm2, r.deviation_ppm));
  }
  return buckets;
}

// The bound that MergeAlike states, and room for rounding.
void ExpectWithinBounds(const std::vector<ReadingBucket>& buckets,
                        const std::vector<RawReading>& readings, std::int64_t time_ns) {
  constexpr double kTolerance = kBucketError + 1e-9;
  const Evidence evidence = Sum(buckets, time_ns);
  const RawSum exact = Sum(readings, time_ns);
  EXPECT_NEAR(evidence.precision, exact.precision, kTolerance * exact.precision);
  EXPECT_NEAR(evidence.weighted_deviation, exact.weighted_deviation,
              kTolerance * exact.weighted_magnitude);
}

TEST(ReadingBucketTest, IsExactForASingleReading) {
  const RawReading reading{5 * kSecond_ns, 0.4, -3.0};
  const std::vector<ReadingBucket> buckets = Buckets({reading});
  for (const std::int64_t time_s : {0, 5, 6, 1000, 1'000'000}) {
    const RawSum exact = Sum({reading}, time_s * kSecond_ns);
    EXPECT_DOUBLE_EQ(Sum(buckets, time_s * kSecond_ns).precision, exact.precision);
    EXPECT_DOUBLE_EQ(Sum(buckets, time_s * kSecond_ns).weighted_deviation,
                     exact.weighted_deviation);
  }
}

TEST(ReadingBucketTest, MergesReadingsOfOneInstantExactly) {
  std::vector<ReadingBucket> buckets = Buckets({{0, 0.1, 1.0}, {0, 0.1, 2.0}, {0, 0.1, 9.0}});
  MergeAlike(0, HalfLife(), buckets);
  ASSERT_EQ(buckets.size(), 1U);
  const Evidence evidence = EvidenceOf(buckets[0], HalfLife(), 120 * kSecond_ns);
  EXPECT_DOUBLE_EQ(evidence.precision, 3.0 / 0.2);
  EXPECT_DOUBLE_EQ(evidence.weighted_deviation, 12.0 / 0.2);
  EXPECT_DOUBLE_EQ(evidence.weighted_square, (1.0 + 4.0 + 81.0) / 0.2);
}

TEST(ReadingBucketTest, KeepsApartWhatDiffersTooMuch) {
  std::vector<ReadingBucket> buckets = Buckets({{0, 0.1, 1.0}, {0, 0.151, 2.0}});
  MergeAlike(0, HalfLife(), buckets);
  EXPECT_EQ(buckets.size(), 2U);
}

TEST(ReadingBucketTest, MergesWhatHasGrownAlikeWithAge) {
  std::vector<ReadingBucket> buckets = Buckets({{0, 0.1, 1.0}, {120 * kSecond_ns, 0.1, 2.0}});
  MergeAlike(120 * kSecond_ns, HalfLife(), buckets);
  EXPECT_EQ(buckets.size(), 2U);
  // Their variances are now 0.31 and 0.21.
  MergeAlike((120 + 132) * kSecond_ns, HalfLife(), buckets);
  EXPECT_EQ(buckets.size(), 1U);
}

TEST(ReadingBucketTest, LeavesReadingsFromTheFutureAlone) {
  std::vector<ReadingBucket> buckets =
      Buckets({{10 * kSecond_ns, 0.1, 1.0}, {0, 0.1, 2.0}, {10 * kSecond_ns, 0.1, 3.0}});
  MergeAlike(9 * kSecond_ns, HalfLife(), buckets);
  EXPECT_EQ(buckets.size(), 3U);
  MergeAlike(10 * kSecond_ns, HalfLife(), buckets);
  EXPECT_EQ(buckets.size(), 1U);
}

TEST(ReadingBucketTest, LeavesNothingOfNothing) {
  std::vector<ReadingBucket> buckets;
  MergeAlike(0, HalfLife(), buckets);
  EXPECT_TRUE(buckets.empty());
}

// Where the bound is hardest to keep: two groups as far apart as a bucket allows, all that
// deviates in one of them.
TEST(ReadingBucketTest, KeepsItsBoundsAtTheWidestSpread) {
  const double most = 0.1 * (1.0 + 0.999999 * kBucketSpread);
  for (const int near : {1, 20, 400}) {
    std::vector<RawReading> readings(static_cast<std::size_t>(near), RawReading{0, 0.1, 0.0});
    readings.push_back({0, most, 10.0});
    std::vector<ReadingBucket> buckets = Buckets(readings);
    MergeAlike(0, HalfLife(), buckets);
    ASSERT_EQ(buckets.size(), 1U);
    ExpectWithinBounds(buckets, readings, 0);
    ExpectWithinBounds(buckets, readings, 1000 * kSecond_ns);
  }
}

TEST(ReadingBucketTest, KeepsItsBoundsAtEverySpread) {
  for (double spread = 0.0; spread < kBucketSpread; spread += 0.01) {
    const std::vector<RawReading> readings = {{0, 0.1, -4.0}, {0, 0.1 * (1.0 + spread), 4.0}};
    std::vector<ReadingBucket> buckets = Buckets(readings);
    MergeAlike(0, HalfLife(), buckets);
    ASSERT_EQ(buckets.size(), 1U);
    for (const std::int64_t time_s : {0, 10, 120, 86400}) {
      ExpectWithinBounds(buckets, readings, time_s * kSecond_ns);
    }
  }
}

TEST(ReadingBucketTest, KeepsItsBoundsHoweverOftenItMerges) {
  Rng rng(5);
  std::vector<RawReading> readings;
  std::vector<ReadingBucket> buckets;
  for (int second = 0; second < 4000; ++second) {
    // Some late, some of other sensors.
    const std::int64_t taken_ns =
        (second - static_cast<std::int64_t>(rng.Below(3) * rng.Below(600))) * kSecond_ns;
    readings.push_back(
        {taken_ns, rng.Below(4) == 0 ? rng.Uniform(0.05, 2.0) : 0.1, rng.Uniform(-5.0, 40.0)});
    buckets.push_back(Buckets({readings.back()})[0]);
    if (second % 7 != 0) continue;
    MergeAlike(second * kSecond_ns, HalfLife(), buckets);
    if (second % 70 == 0) ExpectWithinBounds(buckets, readings, second * kSecond_ns);
  }
  ExpectWithinBounds(buckets, readings, 4000 * kSecond_ns);
  ExpectWithinBounds(buckets, readings, 1'000'000 * kSecond_ns);
}

TEST(ReadingBucketTest, KeepsFewBucketsOfAWeek) {
  constexpr std::int64_t kWeek_s = 7 * 24 * 3600;
  constexpr std::int64_t kPeriod_s = 4;
  std::vector<RawReading> readings;
  std::vector<ReadingBucket> buckets;
  std::size_t most_buckets = 0;
  for (std::int64_t second = 0; second < kWeek_s; second += kPeriod_s) {
    const double wave = 10.0 + 10.0 * std::sin(static_cast<double>(second) / 1000.0);
    readings.push_back({second * kSecond_ns, kDefaultVariance_ppm2, wave});
    buckets.push_back(Buckets({readings.back()})[0]);
    if (second % (15 * kPeriod_s) != 0) continue;
    MergeAlike(second * kSecond_ns, HalfLife(), buckets);
    most_buckets = std::max(most_buckets, buckets.size());
  }
  const double ratio = 1.0 + static_cast<double>(kWeek_s) / kHalfLife_s;
  EXPECT_LE(static_cast<double>(most_buckets),
            2.0 * std::log(ratio) / std::log(1.0 + kBucketSpread) + 2.0);
  ExpectWithinBounds(buckets, readings, kWeek_s * kSecond_ns);
}

TEST(ReadingBucketTest, StaysFiniteAtTheWidestValues) {
  const Ageing ageing = HalfLife(1e-3);
  std::vector<ReadingBucket> buckets;
  for (const double variance_ppm2 : {1e-300, 1e-9, 1.0, 1e300}) {
    for (const std::int64_t taken_ns : {std::numeric_limits<std::int64_t>::min(), std::int64_t{0},
                                        std::numeric_limits<std::int64_t>::max()}) {
      for (const double deviation_ppm : {-1e9, 1e9, 1e9}) {
        buckets.push_back(
            BucketOf(taken_ns, ageing.InitialVariance_ppm2({0.0, variance_ppm2}), deviation_ppm));
      }
    }
  }
  for (const std::int64_t time_ns : {std::numeric_limits<std::int64_t>::min(), std::int64_t{0},
                                     std::numeric_limits<std::int64_t>::max()}) {
    MergeAlike(time_ns, ageing, buckets);
    for (const ReadingBucket& bucket : buckets) {
      const Evidence evidence = EvidenceOf(bucket, ageing, time_ns);
      EXPECT_GT(evidence.precision, 0.0);
      EXPECT_TRUE(std::isfinite(evidence.precision));
      EXPECT_TRUE(std::isfinite(evidence.weighted_deviation));
    }
  }
}

}  // namespace reading_bucket_test
}  // namespace plumescout
