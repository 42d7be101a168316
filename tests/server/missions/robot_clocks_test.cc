// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/robot_clocks.h"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace plumescout::server {
namespace robot_clocks_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kHour_ns = 3600 * kSecond_ns;
constexpr std::int64_t kNow_ns = 1'800'000'000 * kSecond_ns;

std::vector<IncomingObservation> BatchAt(const std::vector<std::int64_t>& times_ns) {
  std::vector<IncomingObservation> batch;
  for (const std::int64_t time_ns : times_ns) {
    const auto sequence = static_cast<std::int64_t>(batch.size()) + 1;
    batch.push_back({{sequence, time_ns, {}, GasReading{}}, absl::OkStatus()});
  }
  return batch;
}

TEST(MissionClockTest, GoesOnThoughTheWallClockIsSet) {
  std::int64_t wall_ns = kNow_ns;
  SteadyTime steady;
  const MissionClock clock([&] { return wall_ns; }, [&] { return steady; });
  steady += std::chrono::seconds(3);
  wall_ns -= kHour_ns;
  EXPECT_EQ(clock.now_ns(), kNow_ns + 3 * kSecond_ns);
}

TEST(RobotClocksTest, SmallDifferencesLeaveTheOffsetThatIsInForce) {
  RobotClocks clocks;
  EXPECT_EQ(clocks.Reckon("r1", {kNow_ns, kNow_ns + 20'000'000}, 0).offset_ns, 0);
  EXPECT_EQ(clocks.Reckon("r2", {kNow_ns, kNow_ns + 20'000'001}, 0).offset_ns, 20'000'001);
}

TEST(RobotClocksTest, TheFirstOffsetIsNoClockThatWasSetALaterOneIs) {
  RobotClocks clocks;
  const auto first = clocks.Reckon("r1", {kNow_ns + kHour_ns, kNow_ns}, 0);
  EXPECT_EQ(first.offset_ns, -kHour_ns);
  EXPECT_FALSE(first.was_set);
  const auto second = clocks.Reckon("r1", {kNow_ns + kSecond_ns, kNow_ns + kSecond_ns}, -kHour_ns);
  EXPECT_EQ(second.offset_ns, 0);
  EXPECT_TRUE(second.was_set);
}

TEST(RobotClocksTest, WhoDoesNotSayIsTakenAsItIs) {
  RobotClocks clocks;
  clocks.Reckon("r1", {kNow_ns + kHour_ns, kNow_ns}, 0);
  const auto reckoning = clocks.Reckon("r1", {0, kNow_ns}, -kHour_ns);
  EXPECT_EQ(reckoning.offset_ns, 0);
  EXPECT_FALSE(reckoning.was_set);
}

// As of a backlog that is read as fast as the rates allow.
TEST(RobotClocksTest, BatchesThatWaitedToBeReadAreOfNoClockThatWasSet) {
  RobotClocks clocks;
  clocks.Reckon("r1", {kNow_ns, kNow_ns}, 0);
  for (int k = 1; k <= 10; ++k) {
    const std::int64_t sent_ns = kNow_ns + k * kSecond_ns;
    const auto reckoning = clocks.Reckon("r1", {sent_ns, sent_ns + 2 * kSecond_ns, true}, 0);
    EXPECT_EQ(reckoning.offset_ns, 0);
    EXPECT_FALSE(reckoning.was_set);
  }
}

TEST(RobotClocksTest, AClockThatWasSetBeforeABatchThatWaitedWasSetOnce) {
  RobotClocks clocks;
  clocks.Reckon("r1", {kNow_ns, kNow_ns}, 0);
  const std::int64_t set_back_ns = kNow_ns - kHour_ns;
  const auto waited =
      clocks.Reckon("r1", {set_back_ns + kSecond_ns, kNow_ns + 3 * kSecond_ns, true}, 0);
  EXPECT_EQ(waited.offset_ns, kHour_ns + 2 * kSecond_ns);
  EXPECT_TRUE(waited.was_set);
  const auto prompt = clocks.Reckon("r1", {set_back_ns + 4 * kSecond_ns, kNow_ns + 4 * kSecond_ns},
                                    waited.offset_ns);
  EXPECT_EQ(prompt.offset_ns, kHour_ns);
  EXPECT_FALSE(prompt.was_set);
}

TEST(RobotClocksTest, RemembersTheLatestBatchAndTheWorstOffset) {
  RobotClocks clocks;
  EXPECT_FALSE(clocks.LinkOf("r1").has_value());
  EXPECT_EQ(clocks.WorstOffset(), absl::ZeroDuration());
  clocks.NoteBatch("r1", {kNow_ns, kNow_ns - 5, -kHour_ns});
  clocks.NoteBatch("r2", {kNow_ns, std::nullopt, 7});
  EXPECT_EQ(clocks.LinkOf("r1")->newest_sample_ns, kNow_ns - 5);
  EXPECT_EQ(clocks.LinkOf("r2")->heard_ns, kNow_ns);
  EXPECT_EQ(clocks.WorstOffset(), absl::Hours(1));
}

TEST(RobotClocksTest, ARobotThatLeavesTakesItsClockAlong) {
  RobotClocks clocks;
  clocks.Reckon("r1", {kNow_ns + kHour_ns, kNow_ns}, 0);
  clocks.NoteBatch("r1", {kNow_ns, kNow_ns, -kHour_ns});
  clocks.NoteBatch("r2", {kNow_ns, kNow_ns, 7});
  clocks.Forget("r1");
  EXPECT_FALSE(clocks.LinkOf("r1").has_value());
  EXPECT_EQ(clocks.WorstOffset(), absl::Nanoseconds(7));
  const auto back = clocks.Reckon("r1", {kNow_ns - kHour_ns, kNow_ns}, 0);
  EXPECT_EQ(back.offset_ns, kHour_ns);
  EXPECT_FALSE(back.was_set) << "it comes with a clock";
}

TEST(TakeMadeBeforeTest, ALeapInTimeIsWhereTheClockWasSet) {
  const std::int64_t later_ns = kNow_ns + kHour_ns;
  auto batch = BatchAt({kNow_ns, kNow_ns + 1, later_ns + 2, later_ns + 3});
  EXPECT_EQ(TakeMadeBefore(kHour_ns, later_ns + 4, batch).size(), 2U);
  EXPECT_EQ(batch.size(), 2U);
  batch = BatchAt({later_ns, later_ns + 1, kNow_ns + 2});
  EXPECT_EQ(TakeMadeBefore(-kHour_ns, kNow_ns + 4, batch).size(), 2U);
  EXPECT_EQ(batch.front().observation.sample_time_ns, kNow_ns + 2);
}

TEST(TakeMadeBeforeTest, WhatLiesAfterItWasSentIsOfTheClockBefore) {
  auto batch = BatchAt({kNow_ns + kHour_ns, kNow_ns + kHour_ns + 1});
  EXPECT_EQ(TakeMadeBefore(-kHour_ns, kNow_ns, batch).size(), 2U);
  EXPECT_TRUE(batch.empty());
}

TEST(TakeMadeBeforeTest, ABatchOfTheNewClockStaysWhole) {
  auto batch = BatchAt({kNow_ns, kNow_ns + 1});
  batch.push_back({{3, 0, {}, SequenceGap{3, 9}}, absl::OkStatus()});
  EXPECT_TRUE(TakeMadeBefore(kHour_ns, kNow_ns + 2, batch).empty());
  EXPECT_TRUE(TakeMadeBefore(-kHour_ns, kNow_ns + 2, batch).empty());
  EXPECT_EQ(batch.size(), 3U);
}

}  // namespace robot_clocks_test
}  // namespace plumescout::server
