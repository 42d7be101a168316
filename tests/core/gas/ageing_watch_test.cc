// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/ageing_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace plumescout {
namespace ageing_watch_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(AgeingWatchTest, ACellWithoutReadingsIsNeverStale) {
  AgeingWatch watch;
  EXPECT_EQ(watch.Error(kSecond_ns), 0.0);
  watch.Add({1, 2});
  EXPECT_EQ(watch.Error(std::numeric_limits<std::int64_t>::max()), 0.0);
  EXPECT_FALSE(watch.IsEpochDue(1'000'000 * kSecond_ns));
  EXPECT_THAT(watch.TooOld(1'000'000 * kSecond_ns), IsEmpty());
}

TEST(AgeingWatchTest, ErrorIsTheLargestFactorThatAnyVarianceMayLack) {
  AgeingWatch watch;
  watch.Set(watch.Add({0, 0}), {10 * kSecond_ns, 0.01});
  watch.Set(watch.Add({1, 0}), {12 * kSecond_ns, 0.05});
  EXPECT_EQ(watch.Error(9 * kSecond_ns), 0.0);
  EXPECT_NEAR(watch.Error(12 * kSecond_ns), 0.02, 1e-12);
  EXPECT_NEAR(watch.Error(13 * kSecond_ns), 0.05, 1e-12);
}

TEST(AgeingWatchTest, TooOldAreThoseThatErrByMoreThanMayBePublished) {
  AgeingWatch watch;
  const std::size_t slow = watch.Add({0, 0});
  const std::size_t fast = watch.Add({1, 0});
  watch.Set(slow, {0, 0.001});
  watch.Set(fast, {0, 1.0});
  EXPECT_THAT(watch.TooOld(kSecond_ns / 10 - 1), IsEmpty());
  EXPECT_THAT(watch.TooOld(kSecond_ns / 10 + 1), ElementsAre(AnchorCell{1, 0}));
  EXPECT_THAT(watch.TooOld(101 * kSecond_ns), ElementsAre(AnchorCell{0, 0}, AnchorCell{1, 0}));
  watch.Set(fast, {101 * kSecond_ns, 0.01});
  EXPECT_THAT(watch.TooOld(101 * kSecond_ns), ElementsAre(AnchorCell{0, 0}));
}

// The epoch is adopted a second after it began.
TEST(AgeingWatchTest, AnEpochIsDueSoThatAgeingStaysWithinItsAim) {
  AgeingWatch watch;
  watch.Set(watch.Add({0, 0}), {0, 0.001});
  EXPECT_FALSE(watch.IsEpochDue(9 * kSecond_ns - 1000));
  EXPECT_TRUE(watch.IsEpochDue(9 * kSecond_ns + 1000));
}

TEST(AgeingWatchTest, NoEpochIsDueForWhatItWouldAgeTooLate) {
  AgeingWatch watch;
  const std::size_t entry = watch.Add({0, 0});
  watch.Set(entry, {0, 0.101});
  EXPECT_FALSE(watch.IsEpochDue(5 * kSecond_ns));
  watch.Set(entry, {0, 0.099});
  EXPECT_TRUE(watch.IsEpochDue(5 * kSecond_ns));
}

}  // namespace ageing_watch_test
}  // namespace plumescout
