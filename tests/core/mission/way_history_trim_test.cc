// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "core/mission/memory_estimate.h"
#include "core/mission/way_history.h"
#include "core/types/error_reason.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/core/mission/kept_way.h"

namespace plumescout {
namespace way_history_trim_test {

using support::kSecond_ns;

class WayHistoryTrimTest : public support::KeptWay {};

TEST_F(WayHistoryTrimTest, WhatIsTrimmedStaysInTheMapButCannotBeCorrected) {
  constexpr int kCount = 300;
  for (int t = 0; t < kCount; ++t) {
    Scan(1.0 + 0.1 * (t % 40), t * kSecond_ns);
    Read(1.0 + 0.1 * (t % 40), t * kSecond_ns);
  }
  OccupancyGrid whole = history_.Base();
  InsertAll(history_.ScansFrom(0), {}, whole);
  const std::int64_t all_bytes = history_.bytes();
  history_.Trim(all_bytes);
  EXPECT_EQ(history_.bytes(), all_bytes);
  // All of it merged: the map, and the readings.
  history_.Trim(5 * static_cast<std::int64_t>(whole.geometry().size()) + kCount * 500);
  EXPECT_TRUE(history_.ScansFrom(0).empty());
  EXPECT_EQ(Readings().counters().readings, kCount);
  EXPECT_EQ(history_.Base().States().values(), whole.States().values());
  const auto corrected = history_.Correct("a", 400 * kSecond_ns, {{5 * kSecond_ns, {}}});
  EXPECT_EQ(corrected.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(ErrorReason(corrected.status()), reason::kHistoryTrimmed);
  ASSERT_TRUE(history_.keeps());
  history_.Trim(history_.bytes() - 1);
  EXPECT_FALSE(history_.keeps()) << "what was merged is too much as well";
  EXPECT_EQ(history_.bytes(), 0);
}

TEST_F(WayHistoryTrimTest, WhoseMapIsTooMuchIsGivenUp) {
  for (int t = 0; t < 40; ++t) Scan(1.0 + 0.1 * t, t * kSecond_ns);
  history_.Trim(1000);
  EXPECT_FALSE(history_.keeps());
  EXPECT_EQ(history_.bytes(), 0);
  EXPECT_TRUE(history_.ScansFrom(0).empty());
  EXPECT_EQ(history_.Base().geometry().size(), 0u) << "nor is there a part of what was merged";
}

TEST_F(WayHistoryTrimTest, ReadingsThatAgeTakeMemoryWhenTheyAreMergedToo) {
  MissionOptions options;
  options.gas.ageing_half_life_s = 60.0;
  history_ = WayHistory(options);
  constexpr auto kCount = static_cast<int>(ReadingStore::kMostArrivals);  // then they are one site
  for (int t = 0; t < kCount; ++t) Read(1.0, t * kSecond_ns);
  history_.Trim(60'000);  // a site and its 255 buckets at most
  ASSERT_TRUE(history_.keeps());
  ASSERT_TRUE(history_.HeardReadings().empty());
  const ReadingStore merged = Readings();
  EXPECT_EQ(merged.arrivals(), 1u);
  EXPECT_GT(merged.arrival_buckets(), 0u);
  EXPECT_EQ(history_.bytes(),
            kReadingSiteBytes +
                kReadingBucketBytes * static_cast<std::int64_t>(merged.arrival_buckets()));
}

}  // namespace way_history_trim_test
}  // namespace plumescout
