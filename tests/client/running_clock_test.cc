// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/running_clock.h"

#include <gtest/gtest.h>

namespace plumescout::client {
namespace running_clock_test {

TEST(RunningClockTest, GoesOnBetweenLooksAndFollowsWhoSetsIt) {
  absl::Duration ticks = absl::Seconds(100);
  RunningClock clock([&] { return ticks; });
  EXPECT_EQ(clock.Now_ns(), 0) << "nobody has looked";
  clock.Note(7'000'000'000);
  ticks += absl::Seconds(2);
  EXPECT_EQ(clock.Now_ns(), 9'000'000'000);
  clock.Note(3'000'000'000);
  EXPECT_EQ(clock.Now_ns(), 3'000'000'000);
}

TEST(RunningClockTest, ALookThatTellsNothingNewDoesNotStopIt) {
  absl::Duration ticks;
  RunningClock clock([&] { return ticks; });
  clock.Note(5);
  ticks += absl::Seconds(1);
  clock.Note(5);
  EXPECT_EQ(clock.Now_ns(), 1'000'000'005);
}

}  // namespace running_clock_test
}  // namespace plumescout::client
