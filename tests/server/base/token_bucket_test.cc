// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/token_bucket.h"

#include <gtest/gtest.h>

namespace plumescout::server {
namespace token_bucket_test {

const SteadyTime kStart = SteadyTime() + std::chrono::hours(1);

TEST(TokenBucketTest, ABurstPassesAndThenTheRate) {
  TokenBucket bucket(2.0, 10.0);
  SteadyTime now = kStart;
  EXPECT_EQ(bucket.WaitFor(10.0, now), absl::ZeroDuration());
  bucket.Take(10.0, now);
  EXPECT_EQ(bucket.WaitFor(1.0, now), absl::Milliseconds(500));
  now += std::chrono::milliseconds(500);
  EXPECT_EQ(bucket.WaitFor(1.0, now), absl::ZeroDuration());
  bucket.Take(1.0, now);
  EXPECT_EQ(bucket.WaitFor(1.0, now), absl::Milliseconds(500));
}

TEST(TokenBucketTest, MoreThanTheBurstPassesAFullBucketAndIsPaidOff) {
  TokenBucket bucket(1.0, 4.0);
  EXPECT_EQ(bucket.WaitFor(9.0, kStart), absl::ZeroDuration());
  bucket.Take(9.0, kStart);
  EXPECT_EQ(bucket.WaitFor(0.0, kStart), absl::Seconds(5));
  EXPECT_EQ(bucket.WaitFor(1.0, kStart + std::chrono::seconds(5)), absl::Seconds(1));
}

TEST(TokenBucketTest, NoMoreThanTheBurstIsSavedUp) {
  TokenBucket bucket(1.0, 4.0);
  bucket.Take(1.0, kStart);
  EXPECT_FALSE(bucket.is_full(kStart));
  const SteadyTime later = kStart + std::chrono::hours(1);
  EXPECT_TRUE(bucket.is_full(later));
  bucket.Take(4.0, later);
  EXPECT_EQ(bucket.WaitFor(1.0, later), absl::Seconds(1));
}

TEST(TokenBucketTest, NoRateIsNoLimit) {
  TokenBucket bucket(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) bucket.Take(1e9, kStart);
  EXPECT_EQ(bucket.WaitFor(1e9, kStart), absl::ZeroDuration());
}

}  // namespace token_bucket_test
}  // namespace plumescout::server
