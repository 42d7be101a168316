// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/travel_levels.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace travel_levels_test {

TEST(TravelLevels, WaitWhileAnyHasAnEntry) {
  TravelLevels<double> levels;
  EXPECT_FALSE(levels.IsWaiting());
  for (const std::int64_t level : {0, 7, 1'000'000}) {
    levels.At(level).diagonal.count = 1;
    EXPECT_TRUE(levels.IsWaiting());
    EXPECT_TRUE(levels.At(level).IsWaiting());
    levels.At(level).Clear();
    EXPECT_FALSE(levels.IsWaiting());
  }
}

TEST(TravelLevels, AreThreeAtOnce) {
  TravelLevels<float> levels;
  for (std::int64_t level = 5; level < 8; ++level) {
    levels.At(level).sources.count = static_cast<std::size_t>(level);
  }
  for (std::int64_t level = 5; level < 8; ++level) {
    EXPECT_EQ(levels.At(level).sources.count, static_cast<std::size_t>(level));
  }
}

TEST(TravelBucket, KeepsWhatIsCountedAndMakesRoom) {
  TravelBucket<double> bucket;
  for (int i = 0; i < 1000; ++i) {
    TravelEntry<double>* const tail = bucket.Tail();
    for (std::size_t k = 0; k < bucket.kRoom; ++k) tail[k] = {i, static_cast<int>(k), 0.5 * i};
    ++bucket.count;
  }
  for (std::size_t i = 0; i < bucket.count; ++i) {
    EXPECT_EQ(bucket.slots[i].cell, static_cast<int>(i));
    EXPECT_EQ(bucket.slots[i].way, 0);
  }
}

}  // namespace travel_levels_test
}  // namespace plumescout
