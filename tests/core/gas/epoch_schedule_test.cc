// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/epoch_schedule.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace epoch_schedule_test {

constexpr GasCellRect kRect{{0, 0}, {100, 100}};
constexpr GasLattice kRoomy{-40, -40, 180, 180};

TEST(EpochScheduleTest, NothingIsDueWhileNothingChanges) {
  EpochSchedule schedule;
  schedule.NoteFresh(10'000);
  schedule.NoteRefresh(0);
  EXPECT_FALSE(schedule.IsDue(kRoomy, kRect));
}

TEST(EpochScheduleTest, DueWhenHalfTheMarginIsUsedUp) {
  EpochSchedule schedule;
  schedule.NoteFresh(10'000);
  const int half = EpochSchedule::Margin_cells(kRect) / 2;
  EXPECT_FALSE(schedule.IsDue({-half, -half, 100 + 2 * half, 100 + 2 * half}, kRect));
  EXPECT_TRUE(schedule.IsDue({-half, 1 - half, 100 + 2 * half, 99 + 2 * half}, kRect));
}

TEST(EpochScheduleTest, MarginFollowsTheMap) {
  EXPECT_EQ(EpochSchedule::Margin_cells({{0, 0}, {1, 1}}), 32);
  EXPECT_EQ(EpochSchedule::Margin_cells({{0, 0}, {80, 800}}), 100);
}

TEST(EpochScheduleTest, DueWhenAFifthOfTheCellsChanged) {
  EpochSchedule schedule;
  schedule.NoteFresh(1000);
  schedule.NoteRefresh(200);
  EXPECT_FALSE(schedule.IsDue(kRoomy, kRect));
  schedule.NoteRefresh(1);
  EXPECT_TRUE(schedule.IsDue(kRoomy, kRect));
  schedule.NoteFresh(1000);
  EXPECT_FALSE(schedule.IsDue(kRoomy, kRect));
}

TEST(EpochScheduleTest, DueBeforeRoundingAddsUp) {
  EpochSchedule schedule;
  schedule.NoteFresh(1000);
  int refreshes = 0;
  while (!schedule.IsDue(kRoomy, kRect) && refreshes < 100'000) {
    schedule.NoteRefresh(0);
    ++refreshes;
  }
  EXPECT_EQ(refreshes, 10'000);
}

}  // namespace epoch_schedule_test
}  // namespace plumescout
