// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// Sensors that lag, whose readings the mission takes along the way.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/gas/way_readings.h"
#include "core/mission/mission.h"
#include "tests/support/box_room.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace mission_readings_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kTick_ns = kSecond_ns / 10;
constexpr int kReadingTicks = 5;

GasSensor Slow() {
  GasSensor sensor;
  sensor.id = "pid";
  sensor.robot_from_sensor = {0.1, 0.0};
  sensor.response_time_s = 0.5;
  return sensor;
}

Pose2 PoseAt(int tick) { return {1.0 + 0.04 * tick, 2.5, 0.0}; }
double Shown_ppm(int tick) { return 5.0 + 4.0 * std::sin(0.1 * tick); }

// A robot drives along a room of 7.1 m x 5.1 m, with a scan at every tick.
class Drive {
 public:
  explicit Drive(const MissionOptions& options = {}) : mission(Mission::Create(options).value()) {}

  void Register(const std::vector<GasSensor>& sensors) {
    RobotRegistered registered{"a", 0.2, ++token_};
    registered.sensors = sensors;
    Apply(registered);
  }
  void See(int tick) { Send(tick, support::ScanInBox(PoseAt(tick), 7.05, 5.05)); }
  void Send(int tick, ObservationPayload payload) {
    Apply(ObservationReceived{
        "a", {++sequence, kSecond_ns + tick * kTick_ns, PoseAt(tick), std::move(payload)}});
  }
  void Tick(int tick) {
    See(tick);
    if (tick % kReadingTicks == 0) Send(tick, GasReading{Shown_ppm(tick)});
  }
  void Refresh(int tick) { Apply(PosteriorRefreshed{kSecond_ns + tick * kTick_ns}); }
  void Apply(const EventBody& body) {
    const auto applied = mission->Apply(body);
    ASSERT_TRUE(applied.ok()) << applied.status();
    ASSERT_TRUE(applied->observation.ok()) << applied->observation;
    ASSERT_TRUE(applied->posterior.ok()) << applied->posterior;
  }
  std::int64_t readings() const { return mission->Snapshot()->gas_counters.readings; }
  std::int64_t cells() const {
    const std::vector<std::uint8_t> sampled = mission->Snapshot()->sampled->values();
    return std::count(sampled.begin(), sampled.end(), 1);
  }

  std::unique_ptr<Mission> mission;
  std::int64_t sequence = 0;

 private:
  std::int64_t token_ = 0;
};

// The same, told to a mission as readings of the air, each where the sensor was.
TEST(MissionReadingsTest, FieldIsThatOfTheReadingsAlongTheWay) {
  Drive lagging;
  lagging.Register({Slow()});
  Drive told;
  GasSensor quick = Slow();
  quick.response_time_s = 0.0;
  told.Register({quick});
  WayReadings way;
  WayModel model;
  model.response_time_s = 0.5;
  model.robot_from_sensor = Slow().robot_from_sensor;
  int parts = 0;
  int readings = 0;
  for (int tick = 0; tick <= 40; ++tick) {
    lagging.Tick(tick);
    told.See(tick);
    const std::int64_t time_ns = kSecond_ns + tick * kTick_ns;
    way.NotePose(time_ns, PoseAt(tick));
    if (tick % kReadingTicks != 0) continue;
    for (const AirReading& air : way.Add(model, time_ns, PoseAt(tick), {Shown_ppm(tick)})) {
      told.Apply(ObservationReceived{"a", {++told.sequence, time_ns, air.pose, air.reading}});
      ++parts;
      readings += air.is_part ? 0 : 1;
    }
  }
  ASSERT_GE(parts, 15);
  EXPECT_EQ(readings, 8) << "of nine the last is not told yet";
  EXPECT_EQ(lagging.readings(), readings) << "each once, in however many cells";
  EXPECT_EQ(told.readings(), parts);
  lagging.Refresh(40);
  told.Refresh(40);
  EXPECT_EQ(lagging.mission->Snapshot()->gas_counters.in_posterior, readings);
  const auto a = lagging.mission->Snapshot();
  const auto b = told.mission->Snapshot();
  ASSERT_EQ(a->geometry(), b->geometry());
  for (std::size_t i = 0; i < a->gas_mean_ppm->size(); ++i) {
    if (std::isnan((*a->gas_mean_ppm)[i])) continue;
    ASSERT_NEAR((*a->gas_mean_ppm)[i], (*b->gas_mean_ppm)[i], 1e-3);
    ASSERT_NEAR((*a->gas_variance_ppm2)[i], (*b->gas_variance_ppm2)[i],
                1e-3 * (*b->gas_variance_ppm2)[i]);
  }
}

TEST(MissionReadingsTest, TheSameEventsGiveTheSameBytesAfterARestore) {
  MissionOptions options;
  options.gas.estimate_noise = true;
  options.gas.scale = GasScale::kSquareRoot;
  Drive live(options);
  live.Register({Slow()});
  for (int tick = 0; tick <= 17; ++tick) live.Tick(tick);
  ASSERT_TRUE(live.mission->can_be_saved());
  Drive restored(options);
  restored.mission = Mission::Restore(options, live.mission->SaveState().value()).value();
  restored.sequence = live.sequence;
  EXPECT_EQ(restored.mission->Digest(), live.mission->Digest());
  for (int tick = 18; tick <= 40; ++tick) {
    live.Tick(tick);
    restored.Tick(tick);
    if (tick % 10 != 0) continue;
    live.Refresh(tick);
    restored.Refresh(tick);
    EXPECT_EQ(restored.mission->Digest(), live.mission->Digest());
  }
  const auto belief = live.mission->Snapshot();
  EXPECT_GE(belief->gas_quality.noise_scale, 1.0);
  EXPECT_NE(belief->Gas(0).published_variance_ppm2(), belief->gas_variance_ppm2);
}

// What was read before is of the way as it was then, or of the sensor.
TEST(MissionReadingsTest, NothingIsLeftUntoldWhenTheWayOrTheSensorsChange) {
  for (const bool corrects : {true, false}) {
    SCOPED_TRACE(corrects);
    Drive drive;
    drive.Register({Slow()});
    for (int tick = 0; tick <= 10; ++tick) drive.Tick(tick);
    const std::int64_t before = drive.readings();
    const std::int64_t cells_before = drive.cells();
    if (corrects) {
      PoseCorrection correction;
      correction.anchors = {{kSecond_ns, PoseAt(0)}, {kSecond_ns + 10 * kTick_ns, PoseAt(10)}};
      drive.Send(11, correction);
    } else {
      drive.Register({Slow()});
    }
    EXPECT_EQ(drive.readings(), before + 1);
    // Between two readings lie 0.2 m of way: two or three cells, the first perhaps known before.
    EXPECT_GE(drive.cells(), cells_before + 1);
    EXPECT_LE(drive.cells(), cells_before + 3);
    const std::int64_t after = drive.readings();
    drive.Send(12, GasReading{5.0});
    EXPECT_EQ(drive.readings(), after + 1) << "the first one again";
  }
}

TEST(MissionReadingsTest, ARefusedCorrectionLeavesUntoldWhatIs) {
  PoseCorrection too_early;
  too_early.anchors = {{kSecond_ns / 2, PoseAt(0)}};
  PoseCorrection too_far;
  too_far.anchors = {{kSecond_ns + 5 * kTick_ns, {1e6, 0.0, 0.0}}};
  Drive drive;
  Drive other;
  for (Drive* one : {&drive, &other}) {
    one->Register({Slow()});
    for (int tick = 0; tick <= 10; ++tick) one->Tick(tick);
  }
  for (const PoseCorrection& correction : {too_early, too_far}) {
    const auto applied = drive.mission->Apply(ObservationReceived{
        "a", {++drive.sequence, kSecond_ns + 10 * kTick_ns, PoseAt(10), correction}});
    ASSERT_TRUE(applied.ok()) << applied.status();
    EXPECT_TRUE(absl::IsInvalidArgument(applied->observation)) << applied->observation;
  }
  EXPECT_EQ(drive.readings(), other.readings());
  for (Drive* one : {&drive, &other}) {
    for (int tick = 11; tick <= 20; ++tick) one->Tick(tick);
    one->Refresh(20);
  }
  EXPECT_EQ(drive.readings(), other.readings());
  EXPECT_TRUE(support::SameBytes(*drive.mission->Snapshot()->gas_mean_ppm,
                                 *other.mission->Snapshot()->gas_mean_ppm));
}

TEST(MissionReadingsTest, SensorsThatLagCountAgainstTheBudget) {
  Drive drive;
  drive.Register({Slow()});
  drive.See(0);
  const std::int64_t before = drive.mission->memory_bytes();
  drive.Send(1, GasReading{5.0});
  const std::int64_t first = drive.mission->memory_bytes() - before;
  EXPECT_GE(first, kWayBytes);
  drive.Send(2, GasReading{5.0});
  EXPECT_LT(drive.mission->memory_bytes() - before, first + kWayBytes) << "there is one way";
  drive.Apply(RobotRemoved{"a"});
  EXPECT_LT(drive.mission->memory_bytes() - before, kWayBytes);
}

// What comes without a pose has the origin of the robot's frame as its pose.
TEST(MissionReadingsTest, WhatSaysNothingOfWhereIsNoPlaceOnTheWay) {
  Drive plain;
  Drive interrupted;
  for (Drive* const drive : {&plain, &interrupted}) {
    drive->Register({Slow()});
    for (int tick = 0; tick <= 40; ++tick) {
      drive->Tick(tick);
      if (drive != &interrupted || tick % kReadingTicks != 2) continue;
      const std::int64_t time_ns = kSecond_ns + tick * kTick_ns;
      drive->Apply(ObservationReceived{"a", {++drive->sequence, time_ns, {}, RobotStatus{0.5}}});
      const std::int64_t lost = ++drive->sequence;
      drive->Apply(ObservationReceived{"a", {lost, time_ns, {}, SequenceGap{lost, lost}}});
    }
    drive->Refresh(40);
  }
  const auto expected = plain.mission->Snapshot();
  const auto told = interrupted.mission->Snapshot();
  EXPECT_TRUE(support::SameBytes(*told->gas_mean_ppm, *expected->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*told->sampled, *expected->sampled));
}

// Two sensors at one place meet often enough after the last refresh.
TEST(MissionReadingsTest, WhoLooksOnChangesNoOffset) {
  Drive seen;
  Drive unseen;
  for (Drive* const drive : {&seen, &unseen}) {
    GasSensor unsure{"b", {}};
    unsure.offset_stddev_ppm = 2.0;
    drive->Register({{"a", {}}, unsure});
    for (int tick = 0; tick <= 40; ++tick) {
      if (tick <= 10) drive->See(tick);
      drive->Send(tick, GasReading{5.0, 0.0, 0});
      drive->Send(tick, GasReading{9.0, 0.0, 1});
      if (tick == 10) drive->Refresh(tick);
      if (drive == &seen) drive->mission->Snapshot();
    }
  }
  EXPECT_EQ(seen.mission->Digest(), unseen.mission->Digest());
  const auto a = seen.mission->Snapshot();
  const auto b = unseen.mission->Snapshot();
  ASSERT_TRUE(a->sensor_offsets.at(0).estimated);
  EXPECT_EQ(a->sensor_offsets, b->sensor_offsets);
  EXPECT_TRUE(support::SameBytes(*a->gas_mean_ppm, *b->gas_mean_ppm));
  EXPECT_TRUE(support::SameBytes(*a->gas_variance_ppm2, *b->gas_variance_ppm2));
}

}  // namespace mission_readings_test
}  // namespace plumescout
