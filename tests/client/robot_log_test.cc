// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/robot_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/types/rng.h"

namespace plumescout::client {
namespace robot_log_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr ReadLimits kEverything = {.through_sequence = 1'000'000,
                                    .max_observations = 1'000'000,
                                    .max_bytes = std::size_t{1} << 40};

Scan ScanOf(std::vector<float> ranges_m) {
  Scan scan;
  scan.ranges_m = std::move(ranges_m);
  return scan;
}

// The sample time tells observations apart.
void AppendGas(RobotLog& log, int count) {
  for (int i = 0; i < count; ++i) {
    const std::int64_t number = log.last_sequence() + 1;
    log.Append(1000 + number, {.x_m = static_cast<double>(number)}, GasReading{});
  }
}

std::vector<std::int64_t> Sequences(const std::vector<Observation>& batch) {
  std::vector<std::int64_t> sequences;
  for (const Observation& observation : batch) sequences.push_back(observation.sequence);
  return sequences;
}

SequenceGap GapOf(const Observation& observation) {
  const auto* gap = std::get_if<SequenceGap>(&observation.payload);
  return gap != nullptr ? *gap : SequenceGap{};
}

TEST(RobotLog, NumbersObservationsFromOneWithoutGaps) {
  RobotLog log({});

  EXPECT_EQ(log.Append(5, {}, GasReading{.concentration_ppm = 2.0}), 1);
  EXPECT_EQ(log.Append(6, {}, ScanOf({1.0F, 2.0F})), 2);

  const std::vector<Observation> batch = log.Read(1, kEverything);
  ASSERT_THAT(batch, SizeIs(2));
  EXPECT_EQ(batch[0].sample_time_ns, 5);
  EXPECT_EQ(std::get<GasReading>(batch[0].payload).concentration_ppm, 2.0);
  EXPECT_THAT(std::get<Scan>(batch[1].payload).ranges_m, ElementsAre(1.0F, 2.0F));
}

TEST(RobotLog, AReturningRobotGoesOnWhereTheServersLogEnds) {
  RobotLog log({}, 41);

  AppendGas(log, 2);

  EXPECT_THAT(Sequences(log.Read(42, kEverything)), ElementsAre(42, 43));
}

TEST(RobotLog, WhatAnEarlierRunSentIsDeclaredAsGapToAServerThatForgotIt) {
  RobotLog log({}, 41);
  AppendGas(log, 1);

  const std::vector<Observation> batch = log.Read(1, kEverything);

  ASSERT_THAT(Sequences(batch), ElementsAre(1, 42));
  EXPECT_EQ(GapOf(batch[0]), (SequenceGap{1, 41}));
}

TEST(RobotLog, ReadsStartAnywhereAndEndAtTheLog) {
  RobotLog log({});
  AppendGas(log, 5);

  EXPECT_THAT(Sequences(log.Read(4, kEverything)), ElementsAre(4, 5));
  EXPECT_THAT(log.Read(6, kEverything), IsEmpty());
  EXPECT_THAT(RobotLog({}).Read(1, kEverything), IsEmpty());
}

TEST(RobotLog, ReadsStopAtTheCreditAndAtTheLimits) {
  RobotLog log({});
  AppendGas(log, 10);

  ReadLimits limits = kEverything;
  limits.through_sequence = 3;
  EXPECT_THAT(Sequences(log.Read(1, limits)), ElementsAre(1, 2, 3));
  EXPECT_THAT(log.Read(4, limits), IsEmpty());

  limits = kEverything;
  limits.max_observations = 2;
  EXPECT_THAT(Sequences(log.Read(7, limits)), ElementsAre(7, 8));

  limits = kEverything;
  limits.max_bytes = 3 * sizeof(Observation);
  EXPECT_THAT(Sequences(log.Read(1, limits)), ElementsAre(1, 2, 3));
}

TEST(RobotLog, OneObservationIsReadHoweverLong) {
  RobotLog log({});
  log.Append(1, {}, ScanOf(std::vector<float>(10'000, 1.0F)));
  ReadLimits limits = kEverything;
  limits.max_bytes = 1;

  EXPECT_THAT(log.Read(1, limits), SizeIs(1));
}

TEST(RobotLog, AppliedEntriesAreKeptUntilDurable) {
  RobotLog log({.max_durable_bytes = 0});
  AppendGas(log, 6);

  log.Acknowledge(4, 2);

  EXPECT_EQ(log.applied_sequence(), 4);
  EXPECT_EQ(log.first_held_sequence(), 3);
  EXPECT_EQ(log.lost_observations(), 0);
  EXPECT_THAT(Sequences(log.Read(3, kEverything)), ElementsAre(3, 4, 5, 6));
}

TEST(RobotLog, AFullLogDropsAppliedEntriesWithoutLoss) {
  RobotLog log({.max_observations = 4});
  AppendGas(log, 4);
  log.Acknowledge(3, 0);

  AppendGas(log, 3);

  EXPECT_EQ(log.first_held_sequence(), 4);
  EXPECT_EQ(log.lost_observations(), 0);
}

TEST(RobotLog, AFullLogDropsTheOldestUnappliedOnceNothingAppliedIsLeft) {
  RobotLog log({.max_observations = 4});
  AppendGas(log, 4);
  log.Acknowledge(1, 0);

  AppendGas(log, 4);

  EXPECT_THAT(log, SizeIs(4));
  EXPECT_EQ(log.first_held_sequence(), 5);
  EXPECT_EQ(log.lost_observations(), 3);  // 2, 3 and 4
}

TEST(RobotLog, DroppedNumbersAreDeclaredWithTheFollowingEntrysTimeAndPose) {
  RobotLog log({.max_observations = 3});
  AppendGas(log, 8);

  const std::vector<Observation> batch = log.Read(2, kEverything);

  ASSERT_THAT(Sequences(batch), ElementsAre(2, 6, 7, 8));
  EXPECT_EQ(GapOf(batch[0]), (SequenceGap{2, 5}));
  EXPECT_EQ(batch[0].sample_time_ns, batch[1].sample_time_ns);
  EXPECT_EQ(batch[0].pose, batch[1].pose);
}

TEST(RobotLog, AGapMayReachBeyondTheCredit) {
  RobotLog log({.max_observations = 2});
  AppendGas(log, 8);
  ReadLimits limits = kEverything;
  limits.through_sequence = 3;

  const std::vector<Observation> batch = log.Read(1, limits);

  ASSERT_THAT(Sequences(batch), ElementsAre(1));
  EXPECT_EQ(GapOf(batch[0]), (SequenceGap{1, 6}));
}

TEST(RobotLog, ARestartedServerIsToldEverythingStillHeld) {
  RobotLog log({.max_observations = 5});
  AppendGas(log, 7);
  log.Acknowledge(7, 0);

  log.Acknowledge(0, 0);

  EXPECT_EQ(log.applied_sequence(), 0);
  EXPECT_THAT(Sequences(log.Read(1, kEverything)), ElementsAre(1, 3, 4, 5, 6, 7));
}

TEST(RobotLog, TheByteBoundHoldsAndAtLeastOneEntryStays) {
  constexpr std::size_t kBound_bytes = 10'000;
  RobotLog log({.max_observations = 1000, .max_bytes = kBound_bytes});
  for (int i = 0; i < 50; ++i) {
    log.Append(i, {}, ScanOf(std::vector<float>(360, 1.0F)));
    EXPECT_LE(log.MemoryBytes(), kBound_bytes);
  }
  EXPECT_GE(log.size(), 4U);  // 10000 / (360 * 4 + 100 or so) = 6

  log.Append(50, {}, ScanOf(std::vector<float>(9000, 1.0F)));

  EXPECT_THAT(log, SizeIs(1));
  EXPECT_EQ(log.first_held_sequence(), 51);
}

TEST(RobotLog, ABoundOfZeroEntriesStillHoldsOne) {
  RobotLog log({.max_observations = 0});

  AppendGas(log, 3);

  EXPECT_THAT(Sequences(log.Read(1, kEverything)), ElementsAre(1, 3));
}

TEST(RobotLog, MemoryIsGivenBackWhenEntriesBecomeDurable) {
  RobotLog log({.max_durable_bytes = 0});
  AppendGas(log, 100);

  log.Acknowledge(100, 100);

  EXPECT_THAT(log, SizeIs(0));
  EXPECT_EQ(log.MemoryBytes(), 0U);
  EXPECT_EQ(log.first_held_sequence(), 101);
}

TEST(RobotLog, DurableEntriesStayWithinTheirBound) {
  RobotLog log({.max_durable_bytes = 3 * sizeof(Observation)});
  AppendGas(log, 10);

  log.Acknowledge(10, 8);
  EXPECT_EQ(log.first_held_sequence(), 6);  // 6, 7 and 8 are durable
  EXPECT_EQ(log.durable_sequence(), 8);

  log.Acknowledge(6, 6);  // a server that was set back
  EXPECT_THAT(Sequences(log.Read(7, kEverything)), ElementsAre(7, 8, 9, 10));
  log.Acknowledge(10, 10);
  EXPECT_EQ(log.first_held_sequence(), 8);
  EXPECT_EQ(log.MemoryBytes(), 3 * sizeof(Observation));
  EXPECT_EQ(log.lost_observations(), 0);
}

TEST(RobotLog, AServerThatLacksWhatIsForgottenIsToldSoWithoutANewEntry) {
  RobotLog log({.max_durable_bytes = 0});
  AppendGas(log, 10);
  log.Acknowledge(10, 10);

  const std::vector<Observation> batch = log.Read(4, kEverything);

  ASSERT_THAT(Sequences(batch), ElementsAre(4));
  EXPECT_EQ(GapOf(batch[0]), (SequenceGap{4, 10}));
  EXPECT_EQ(batch[0].sample_time_ns, 1010);
}

TEST(RobotLog, WhatIsNotAppliedFollowsAnotherLog) {
  RobotLog log({});
  AppendGas(log, 6);
  log.Acknowledge(4, 0);

  EXPECT_EQ(log.RebaseAfter(100), (Renumbering{5, 101}));

  EXPECT_EQ(log.applied_sequence(), 100);
  EXPECT_EQ(log.last_sequence(), 102);
  const std::vector<Observation> batch = log.Read(101, kEverything);
  ASSERT_THAT(Sequences(batch), ElementsAre(101, 102));
  EXPECT_EQ(batch[0].sample_time_ns, 1005);
  EXPECT_EQ(log.Append(0, {}, GasReading{}), 103);
  EXPECT_EQ(log.lost_observations(), 0);
}

TEST(RobotLog, NumbersMayFallWithAnotherLogToo) {
  RobotLog log({}, 50);
  AppendGas(log, 3);

  EXPECT_EQ(log.RebaseAfter(2), (Renumbering{51, 3}));

  EXPECT_THAT(Sequences(log.Read(3, kEverything)), ElementsAre(3, 4, 5));
}

TEST(RobotLog, AnEmptyLogGoesOnAfterAnother) {
  RobotLog log({});
  EXPECT_EQ(log.RebaseAfter(41), (Renumbering{1, 42}));
  EXPECT_EQ(log.Append(0, {}, GasReading{}), 42);
}

TEST(RobotLog, NumbersThatArePassedOverAreAGap) {
  RobotLog log({});
  AppendGas(log, 2);
  log.SkipTo(5);
  log.SkipTo(3);  // is behind
  AppendGas(log, 1);

  const std::vector<Observation> batch = log.Read(1, kEverything);

  ASSERT_THAT(Sequences(batch), ElementsAre(1, 2, 3, 6));
  EXPECT_EQ(GapOf(batch[2]), (SequenceGap{3, 5}));
  EXPECT_EQ(GapOf(log.Read(4, kEverything)[0]), (SequenceGap{4, 5}));  // the rest of it
  EXPECT_EQ(log.lost_observations(), 0);
}

TEST(RobotLog, AKeptLogGoesOnAsItWas) {
  KeptLog kept{.epoch = 7, .last_sequence = 9, .applied_sequence = 4, .durable_sequence = 4};
  for (const std::int64_t number : {3, 4, 5, 8}) {
    kept.entries.push_back(
        {.sequence = number, .sample_time_ns = number, .pose = {}, .payload = GasReading{}});
  }
  RobotLog log({.max_durable_bytes = sizeof(Observation)});

  log.Restore(std::move(kept));

  EXPECT_EQ(log.first_held_sequence(), 4);
  EXPECT_EQ(log.applied_sequence(), 4);
  const std::vector<Observation> batch = log.Read(5, kEverything);
  ASSERT_THAT(Sequences(batch), ElementsAre(5, 6, 8, 9));
  EXPECT_EQ(GapOf(batch[1]), (SequenceGap{6, 7}));
  EXPECT_EQ(GapOf(batch[3]), (SequenceGap{9, 9}));
  EXPECT_EQ(log.Append(0, {}, GasReading{}), 10);
}

// Whatever is appended, acknowledged and dropped, a reader that starts anywhere sees every number
// from there on exactly once, as an observation or within a gap.
TEST(RobotLog, EveryNumberIsAccountedForUnderRandomUse) {
  Rng rng(42);
  RobotLog log({.max_observations = 20});
  std::int64_t durable = 0;
  for (int step = 0; step < 2000; ++step) {
    AppendGas(log, static_cast<int>(rng.Below(8)));
    const auto span = static_cast<std::uint64_t>(log.last_sequence() - durable + 1);
    const std::int64_t applied = durable + static_cast<std::int64_t>(rng.Below(span));
    if (rng.Below(4) == 0) durable += (applied - durable) / 2;
    log.Acknowledge(applied, durable);

    const std::int64_t start = applied + 1;
    std::int64_t expected = start;
    for (const Observation& observation : log.Read(start, kEverything)) {
      ASSERT_EQ(observation.sequence, expected);
      expected = LastSequence(observation) + 1;
    }
    ASSERT_EQ(expected, log.last_sequence() + 1);
    ASSERT_LE(log.size(), 20U);
  }
}

}  // namespace robot_log_test
}  // namespace plumescout::client
