// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/epoch_schedule.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumescout {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr GasCellBox kBox{0, 0, 100, 100};
constexpr GasLattice kRoomy{-40, -40, 180, 180};

GasOptions Ageing(double half_life_s) {
  GasOptions options;
  options.ageing_half_life_s = half_life_s;
  return options;
}

TEST(EpochScheduleTest, NothingIsDueWhileNothingChanges) {
  EpochSchedule schedule{GasOptions()};
  schedule.NoteReading({5.0});
  schedule.NoteFresh(0, 10'000);
  EXPECT_FALSE(schedule.IsDue(kRoomy, kBox, 1'000'000 * kSecond_ns));
  EXPECT_EQ(schedule.AgeingError(1'000'000 * kSecond_ns), 0.0);
}

TEST(EpochScheduleTest, DueWhenHalfTheMarginIsUsedUp) {
  EpochSchedule schedule{GasOptions()};
  schedule.NoteFresh(0, 10'000);
  const int half = EpochSchedule::Margin_cells(kBox) / 2;
  EXPECT_FALSE(schedule.IsDue({-half, -half, 100 + 2 * half, 100 + 2 * half}, kBox, 0));
  EXPECT_TRUE(schedule.IsDue({-half, 1 - half, 100 + 2 * half, 99 + 2 * half}, kBox, 0));
}

TEST(EpochScheduleTest, MarginFollowsTheMap) {
  EXPECT_EQ(EpochSchedule::Margin_cells({0, 0, 1, 1}), 32);
  EXPECT_EQ(EpochSchedule::Margin_cells({0, 0, 80, 800}), 100);
}

TEST(EpochScheduleTest, DueWhenAFifthOfTheCellsChanged) {
  EpochSchedule schedule{GasOptions()};
  schedule.NoteFresh(0, 1000);
  schedule.NoteRefresh(200);
  EXPECT_FALSE(schedule.IsDue(kRoomy, kBox, 0));
  schedule.NoteRefresh(1);
  EXPECT_TRUE(schedule.IsDue(kRoomy, kBox, 0));
  schedule.NoteFresh(0, 1000);
  EXPECT_FALSE(schedule.IsDue(kRoomy, kBox, 0));
}

TEST(EpochScheduleTest, DueBeforeRoundingAddsUp) {
  EpochSchedule schedule{GasOptions()};
  schedule.NoteFresh(0, 1000);
  int refreshes = 0;
  while (!schedule.IsDue(kRoomy, kBox, 0) && refreshes < 100'000) {
    schedule.NoteRefresh(0);
    ++refreshes;
  }
  EXPECT_EQ(refreshes, 10'000);
}

// lambda(t) = lambda_o / (1 + t / half-life): after t all precisions have lost the factor 1 + t /
// h.
TEST(EpochScheduleTest, AgeingErrorIsTheLargestFactorThatAnyVarianceMayLack) {
  EpochSchedule schedule(Ageing(100.0));
  EXPECT_EQ(schedule.AgeingError(kSecond_ns), 0.0) << "no reading yet";
  schedule.NoteReading({5.0});
  schedule.NoteFresh(0, 100);
  EXPECT_NEAR(schedule.AgeingError(5 * kSecond_ns), 0.05, 1e-12);
  schedule.NoteReading({5.0, 0.02});  // five times the default precision
  EXPECT_NEAR(schedule.AgeingError(5 * kSecond_ns), 0.25, 1e-12);
  schedule.NoteReading({5.0, std::numeric_limits<double>::infinity()});
  schedule.NoteReading({5.0, 7.0});
  EXPECT_NEAR(schedule.AgeingError(5 * kSecond_ns), 0.25, 1e-12);
}

TEST(EpochScheduleTest, DueSoThatAgeingStaysWithinItsAim) {
  EpochSchedule schedule(Ageing(1000.0));
  schedule.NoteReading({5.0});
  schedule.NoteFresh(0, 100);
  EXPECT_FALSE(schedule.IsDue(kRoomy, kBox, 9 * kSecond_ns - 1));
  EXPECT_TRUE(schedule.IsDue(kRoomy, kBox, 9 * kSecond_ns + 1));
  EXPECT_FALSE(schedule.IsDue(kRoomy, kBox, 100 * kSecond_ns)) << "it would come too late";
  EXPECT_FALSE(schedule.IsTooOld(100 * kSecond_ns - 1));
  EXPECT_TRUE(schedule.IsTooOld(100 * kSecond_ns + 1));
}

}  // namespace
}  // namespace plumescout
