// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/clock_history.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace plumescout {
namespace clock_history_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(ClockHistoryTest, WithoutChangesItIsTheOffsetInForce) {
  ClockHistory history;
  EXPECT_EQ(history.MissionTime_ns(7, -3), 4);
  history.End(5);  // before anything was taken
  history.Take(100);
  EXPECT_EQ(history.MissionTime_ns(7, -3), 4);
}

TEST(ClockHistoryTest, WhatWasTakenByAnEarlierOffsetKeepsItsTime) {
  ClockHistory history;
  history.Take(1010);  // 1000 by the clock
  history.End(10);
  history.Take(1110);  // 1095: it runs slow
  history.End(15);
  EXPECT_EQ(history.MissionTime_ns(900, 20), 910);
  EXPECT_EQ(history.MissionTime_ns(1000, 20), 1010);
  EXPECT_EQ(history.MissionTime_ns(1001, 20), 1016);
  EXPECT_EQ(history.MissionTime_ns(1095, 20), 1110);
  EXPECT_EQ(history.MissionTime_ns(1096, 20), 1116);
}

TEST(ClockHistoryTest, AClockThatWasSetForwardNeverShowedSomeTimes) {
  ClockHistory history;
  history.Take(100 * kSecond_ns);
  history.End(0);
  history.Take(101 * kSecond_ns);  // 131 by the clock
  const auto at = [&](std::int64_t robot_s) {
    return history.MissionTime_ns(robot_s * kSecond_ns, -30 * kSecond_ns) / kSecond_ns;
  };
  EXPECT_EQ(at(90), 90);
  EXPECT_EQ(at(100), 100);
  EXPECT_EQ(at(101), 100);
  EXPECT_EQ(at(129), 100);
  EXPECT_EQ(at(131), 101);
}

TEST(ClockHistoryTest, AClockThatWasSetBackShowedSomeTimesTwice) {
  ClockHistory history;
  history.Take(100 * kSecond_ns);
  history.End(0);
  history.Take(110 * kSecond_ns);  // 80 by the clock
  const auto at = [&](std::int64_t robot_s) {
    return history.MissionTime_ns(robot_s * kSecond_ns, 30 * kSecond_ns) / kSecond_ns;
  };
  EXPECT_EQ(at(70), 70);
  EXPECT_EQ(at(75), 105);
  EXPECT_EQ(at(80), 110);
}

TEST(ClockHistoryTest, OfVeryManyOffsetsTheOldestAreForgotten) {
  ClockHistory history;
  for (int k = 0; k < 1000; ++k) {
    history.Take(100 * k);
    history.End(k);
  }
  EXPECT_EQ(history.MissionTime_ns(99'900 - 999, 1000), 99'900);
  EXPECT_EQ(history.MissionTime_ns(80'000 - 800, 1000), 80'000);
  EXPECT_EQ(history.MissionTime_ns(10, 1000), 10 + 744);
}

}  // namespace clock_history_test
}  // namespace plumescout
