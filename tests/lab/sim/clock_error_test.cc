// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/clock_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace clock_error_test {

constexpr std::int64_t kStart_ns = 1'700'000'000'123'456'789;

TEST(ClockError, ARightClockIsRightToTheNanosecond) {
  EXPECT_EQ(ToldTime_ns({}, kStart_ns, kStart_ns + 7), kStart_ns + 7);
}

TEST(ClockError, AClockIsAheadAndGainsOnTheWorlds) {
  const ClockErrorOptions options{.offset_s = -3600.0, .drift_ppm = 100.0};
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  EXPECT_EQ(ToldTime_ns(options, kStart_ns, kStart_ns), kStart_ns - 3600 * kSecond_ns);
  EXPECT_EQ(ToldTime_ns(options, kStart_ns, kStart_ns + 1000 * kSecond_ns),
            kStart_ns - 2600 * kSecond_ns + kSecond_ns / 10);
}

TEST(ClockError, IsUndone) {
  EXPECT_EQ(WorldTime_ns({}, kStart_ns, kStart_ns + 7), kStart_ns + 7);
  const ClockErrorOptions options{.offset_s = -3600.0, .drift_ppm = 100.0};
  const std::int64_t then_ns = kStart_ns + 1'000'000'000'000;
  EXPECT_EQ(WorldTime_ns(options, kStart_ns, ToldTime_ns(options, kStart_ns, then_ns)), then_ns);
}

TEST(ClockError, NamesWhatIsOutOfRange) {
  EXPECT_TRUE(Validate(ClockErrorOptions{}).ok());
  EXPECT_FALSE(Validate(ClockErrorOptions{.offset_s = 1.1e6}).ok());
  EXPECT_FALSE(Validate(ClockErrorOptions{.offset_s = std::nan("")}).ok());
  EXPECT_FALSE(Validate(ClockErrorOptions{.drift_ppm = -10001.0}).ok());
}

}  // namespace clock_error_test
}  // namespace plumescout::lab
