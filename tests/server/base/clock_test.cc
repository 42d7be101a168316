// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/clock.h"

#include <gtest/gtest.h>

namespace plumescout::server {
namespace clock_test {

TEST(ClockTest, AfterAddsAndTakesAway) {
  const SteadyTime from = SteadyTime() + std::chrono::seconds(100);
  EXPECT_EQ(After(from, absl::Seconds(2)), from + std::chrono::seconds(2));
  EXPECT_EQ(After(from, -absl::Seconds(2)), from - std::chrono::seconds(2));
}

TEST(ClockTest, AfterSaturates) {
  EXPECT_EQ(After(SteadyNow(), absl::InfiniteDuration()), SteadyTime::max());
  EXPECT_EQ(After(SteadyTime::max(), absl::Seconds(1)), SteadyTime::max());
  EXPECT_EQ(After(SteadyTime::max(), -absl::Seconds(1)), SteadyTime::max());
  EXPECT_LT(After(SteadyNow(), -absl::InfiniteDuration()), SteadyNow());
}

TEST(ClockTest, NoDeadlineStaysNone) {
  EXPECT_EQ(ToSteady(std::chrono::system_clock::time_point::max()), SteadyTime::max());
}

TEST(ClockTest, DeadlineOfTheWallClockKeepsItsDistance) {
  const SteadyTime before = SteadyNow();
  const SteadyTime deadline = ToSteady(std::chrono::system_clock::now() + std::chrono::hours(1));
  EXPECT_GT(deadline, before + std::chrono::minutes(59));
  EXPECT_LE(deadline, SteadyNow() + std::chrono::hours(1));
}

}  // namespace clock_test
}  // namespace plumescout::server
