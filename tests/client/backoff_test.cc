// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/backoff.h"

#include <gtest/gtest.h>

namespace plumescout::client {
namespace backoff_test {

TEST(Backoff, WaitsGrowByTheFactorUpToTheMaximum) {
  Backoff backoff({.initial = absl::Milliseconds(100),
                   .maximum = absl::Seconds(1),
                   .factor = 3.0,
                   .jitter = 0.0});

  EXPECT_EQ(backoff.Next(), absl::Milliseconds(100));
  EXPECT_EQ(backoff.Next(), absl::Milliseconds(300));
  EXPECT_EQ(backoff.Next(), absl::Milliseconds(900));
  EXPECT_EQ(backoff.Next(), absl::Seconds(1));
  EXPECT_EQ(backoff.Next(), absl::Seconds(1));
}

TEST(Backoff, JitterSpreadsWaitsWithinItsShareAndNeverBeyondTheMaximum) {
  const BackoffOptions options{.initial = absl::Milliseconds(100),
                               .maximum = absl::Milliseconds(105),
                               .factor = 1.0,
                               .jitter = 0.2};
  Backoff backoff(options);

  absl::Duration least = absl::InfiniteDuration();
  absl::Duration greatest = absl::ZeroDuration();
  for (int i = 0; i < 200; ++i) {
    const absl::Duration wait = backoff.Next();
    least = std::min(least, wait);
    greatest = std::max(greatest, wait);
  }

  EXPECT_GE(least, absl::Milliseconds(80));
  EXPECT_LT(least, absl::Milliseconds(90));
  EXPECT_EQ(greatest, absl::Milliseconds(105));
}

TEST(Backoff, TheSameSeedGivesTheSameWaitsAndAnotherSeedOthers) {
  Backoff first({.seed = 7});
  Backoff again({.seed = 7});
  Backoff other({.seed = 8});

  const absl::Duration wait = first.Next();

  EXPECT_EQ(wait, again.Next());
  EXPECT_NE(wait, other.Next());
}

TEST(Backoff, ResetStartsAgainFromTheInitialWait) {
  Backoff backoff({.initial = absl::Milliseconds(10), .jitter = 0.0});
  backoff.Next();
  backoff.Next();

  backoff.Reset();

  EXPECT_EQ(backoff.Next(), absl::Milliseconds(10));
}

}  // namespace backoff_test
}  // namespace plumescout::client
