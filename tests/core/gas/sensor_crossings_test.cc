// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/sensor_crossings.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "core/types/rng.h"

namespace plumescout {
namespace sensor_crossings_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(SensorCrossingsTest, CountsWhatWasReadNearAndSoon) {
  SensorCrossings crossings;
  crossings.Add(0, 0, {0.0, 0.0}, 5.0);
  crossings.Add(1, 30 * kSecond_ns, {0.9, 0.0}, 5.0);
  EXPECT_EQ(crossings.Count(0), 1);
  EXPECT_EQ(crossings.Count(1), 1);
  crossings.Add(1, 31 * kSecond_ns, {1.1, 0.0}, 5.0);  // too far
  crossings.Add(1, 61 * kSecond_ns, {0.0, 0.0}, 5.0);  // too late
  EXPECT_EQ(crossings.Count(0), 1);
  crossings.Add(2, 62 * kSecond_ns, {0.5, 0.0}, 5.0);  // sensor 1, once though it read there twice
  EXPECT_EQ(crossings.Count(2), 1);
  EXPECT_EQ(crossings.Count(1), 2);
}

TEST(SensorCrossingsTest, AReadingOfTheFutureCountsToo) {
  SensorCrossings crossings;
  crossings.Add(0, 20 * kSecond_ns, {0.0, 0.0}, 5.0);
  crossings.Add(1, 0, {0.0, 0.0}, 5.0);
  EXPECT_EQ(crossings.Count(1), 1);
}

TEST(SensorCrossingsTest, ASensorDoesNotMeetItself) {
  SensorCrossings crossings;
  for (int i = 0; i < 50; ++i) crossings.Add(0, i * kSecond_ns, {0.0, 0.0}, 5.0);
  EXPECT_EQ(crossings.Count(0), 0);
  EXPECT_FALSE(crossings.IsLinked(0));
}

TEST(SensorCrossingsTest, TwoAreLinkedOnceTheyMetOftenEnough) {
  SensorCrossings crossings;
  crossings.Add(0, 0, {0.0, 0.0}, 5.0);
  for (std::int64_t i = 1; i < SensorCrossings::kEnough; ++i) {
    crossings.Add(1, i * kSecond_ns, {0.0, 0.5}, 5.0);
  }
  EXPECT_FALSE(crossings.IsLinked(1));
  crossings.Add(1, 30 * kSecond_ns, {0.0, 0.5}, 5.0);
  EXPECT_TRUE(crossings.IsLinked(0));
  EXPECT_TRUE(crossings.IsLinked(1));
  EXPECT_FALSE(crossings.IsLinked(2));
}

// Two that stand side by side in a plume that fluctuates; from the reading `changes_at` on the
// second reads `change_ppm` more.
SensorCrossings SideBySide(int readings, int changes_at, double change_ppm) {
  SensorCrossings crossings;
  Rng rng(1);
  for (int i = 0; i < readings; ++i) {
    const double change = i >= changes_at ? change_ppm : 0.0;
    crossings.Add(0, i * kSecond_ns, {0.0, 0.0}, 10.0 + rng.Uniform(-1.0, 1.0));
    crossings.Add(1, i * kSecond_ns, {0.3, 0.0}, 11.0 + rng.Uniform(-1.0, 1.0) + change);
  }
  return crossings;
}

TEST(SensorCrossingsTest, NoticesASensorThatReadsOtherThanBefore) {
  EXPECT_FALSE(SideBySide(200, 200, 0.0).IsDrifting(1, 0.5));
  EXPECT_FALSE(SideBySide(200, 0, 5.0).IsDrifting(1, 0.5));  // an offset is no drift
  EXPECT_TRUE(SideBySide(200, 180, 3.0).IsDrifting(1, 0.5));
  EXPECT_TRUE(SideBySide(200, 180, 3.0).IsDrifting(0, 0.5));   // who of the two is not to be told
  EXPECT_FALSE(SideBySide(200, 180, 3.0).IsDrifting(1, 5.0));  // less than matters
}

TEST(SensorCrossingsTest, TellsNothingOfDriftFromFewReadings) {
  EXPECT_FALSE(SideBySide(18, 10, 50.0).IsDrifting(1, 0.5));
}

}  // namespace sensor_crossings_test
}  // namespace plumescout
