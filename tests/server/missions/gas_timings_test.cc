// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/gas_timings.h"

#include <gtest/gtest.h>

namespace plumescout::server {
namespace gas_timings_test {

SteadyTime At(int ms) { return SteadyTime() + std::chrono::milliseconds(ms); }

TEST(LatencyWindowTest, FiguresOfNothingAreZero) {
  const LatencyFigures figures = LatencyWindow().Figures();
  EXPECT_EQ(figures.samples, 0);
  EXPECT_EQ(figures.max, absl::ZeroDuration());
}

TEST(LatencyWindowTest, QuantilesAreOfAllSamples) {
  LatencyWindow window;
  for (int i = 200; i >= 0; --i) window.Add(absl::Milliseconds(i));
  const LatencyFigures figures = window.Figures();
  EXPECT_EQ(figures.samples, 201);
  EXPECT_EQ(figures.median, absl::Milliseconds(100));
  EXPECT_EQ(figures.p99, absl::Milliseconds(198));
  EXPECT_EQ(figures.max, absl::Milliseconds(200));
}

TEST(LatencyWindowTest, OldSamplesLeave) {
  LatencyWindow window;
  window.Add(absl::Seconds(9));
  for (std::size_t i = 0; i < kLatencyWindow; ++i) window.Add(absl::Milliseconds(1));
  const LatencyFigures figures = window.Figures();
  EXPECT_EQ(figures.samples, static_cast<std::int64_t>(kLatencyWindow) + 1);
  EXPECT_EQ(figures.max, absl::Milliseconds(1));
}

TEST(GasTimerTest, StalenessRunsFromTheFirstReadingThatAPublicationIsTheFirstToHold) {
  GasTimer timer;
  timer.NoteReading(At(10));
  timer.NoteReading(At(15));
  EXPECT_EQ(timer.unpublished_since(), At(10));
  EXPECT_FALSE(timer.unpublished_in_posterior());
  timer.NotePublication(At(20));  // does not hold it yet
  EXPECT_EQ(timer.timings().staleness.samples, 0);
  timer.NoteRefresh(At(30), At(33));
  timer.NoteReading(At(40));
  EXPECT_TRUE(timer.unpublished_in_posterior());
  timer.NotePublication(At(50));
  EXPECT_EQ(timer.timings().staleness.samples, 1);
  EXPECT_EQ(timer.timings().staleness.max, absl::Milliseconds(40));
  EXPECT_EQ(timer.unpublished_since(), At(40));
  EXPECT_FALSE(timer.unpublished_in_posterior());
}

TEST(GasTimerTest, RefreshesBetweenPublicationsKeepTheFirstReading) {
  GasTimer timer;
  timer.NoteReading(At(10));
  timer.NoteRefresh(At(11), At(12));
  timer.NoteReading(At(20));
  timer.NoteRefresh(At(21), At(22));
  timer.NotePublication(At(30));
  EXPECT_EQ(timer.timings().staleness.max, absl::Milliseconds(20));
  EXPECT_EQ(timer.unpublished_since(), SteadyTime::max());
}

TEST(GasTimerTest, UpdatesAreRefreshesAndAdoptions) {
  GasTimer timer;
  timer.NoteRefresh(At(10), At(12));
  timer.NoteAdoption(At(20), At(27));
  EXPECT_EQ(timer.timings().update.samples, 2);
  EXPECT_EQ(timer.timings().update.median, absl::Microseconds(4500));
  EXPECT_EQ(timer.timings().update.max, absl::Milliseconds(7));
}

TEST(GasTimerTest, WhoBeginsToWatchHasNotWaitedBefore) {
  GasTimer timer;
  timer.NoteReading(At(10));
  timer.NoteRefresh(At(11), At(12));
  timer.NoteReading(At(20));
  timer.Restart(At(1000));
  EXPECT_EQ(timer.unpublished_since(), At(1000));
  EXPECT_FALSE(timer.unpublished_in_posterior());
  timer.NoteRefresh(At(1001), At(1002));
  timer.NotePublication(At(1005));
  EXPECT_EQ(timer.timings().staleness.max, absl::Milliseconds(5));
}

}  // namespace gas_timings_test
}  // namespace plumescout::server
