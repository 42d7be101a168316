// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/sensor_bridge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/client/fake_driver.h"

namespace plumescout::client {
namespace sensor_bridge_test {

using ::testing::ElementsAre;
using ::testing::SizeIs;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

struct Sample {
  std::int64_t time_ns;
  Pose2 pose;
  bool is_scan;
};

SensorBridge::Sink Into(std::vector<Sample>& samples) {
  return [&samples](std::int64_t time_ns, const Pose2& pose, ObservationPayload payload) {
    samples.push_back({time_ns, pose, std::holds_alternative<Scan>(payload)});
  };
}

std::ptrdiff_t CountScans(const std::vector<Sample>& samples) {
  return std::count_if(samples.begin(), samples.end(), [](const Sample& s) { return s.is_scan; });
}

TEST(SampleSchedule, ReadingsAreDueOnTheGridOfTheStart) {
  SampleSchedule schedule(100, 10.0);

  EXPECT_TRUE(schedule.Due(100));
  EXPECT_FALSE(schedule.Due(100));
  EXPECT_FALSE(schedule.Due(100 + kSecond_ns / 20));
  EXPECT_TRUE(schedule.Due(100 + kSecond_ns / 10));
  EXPECT_EQ(schedule.next_ns(), 100 + kSecond_ns / 5);
}

TEST(SampleSchedule, LatenessAndRoundingNeverAddUp) {
  SampleSchedule schedule(0, 3.0);  // a period that is no whole number of nanoseconds
  int due = 0;
  for (std::int64_t now_ns = 0; now_ns < 1001 * kSecond_ns; now_ns += 7'000'000) {
    if (schedule.Due(now_ns)) ++due;
  }

  EXPECT_EQ(due, 3003);  // 1001 s at 3 Hz
}

TEST(SampleSchedule, AClockThatRoundsDownDoesNotCostEveryOtherReading) {
  SampleSchedule schedule(0, 10.0);
  int due = 0;
  for (std::int64_t tick = 0; tick < 100; ++tick) {
    if (schedule.Due(tick * kSecond_ns / 10 - (tick % 2))) ++due;
  }

  EXPECT_EQ(due, 100);
}

TEST(SampleSchedule, MissedReadingsAreSkippedNotMadeUpFor) {
  SampleSchedule schedule(0, 10.0);
  EXPECT_TRUE(schedule.Due(0));

  EXPECT_TRUE(schedule.Due(5 * kSecond_ns));
  EXPECT_FALSE(schedule.Due(5 * kSecond_ns));
  EXPECT_EQ(schedule.next_ns(), 5 * kSecond_ns + kSecond_ns / 10);
}

TEST(SampleSchedule, AClockSetBackStartsTheGridAnew) {
  SampleSchedule schedule(1000 * kSecond_ns, 2.0);
  EXPECT_TRUE(schedule.Due(1000 * kSecond_ns));

  EXPECT_TRUE(schedule.Due(10 * kSecond_ns));
  EXPECT_EQ(schedule.next_ns(), 10 * kSecond_ns + kSecond_ns / 2);
}

TEST(SampleSchedule, ARateOfZeroIsNeverDue) {
  SampleSchedule schedule(0, 0.0);

  EXPECT_FALSE(schedule.Due(kSecond_ns));
  EXPECT_EQ(schedule.next_ns(), std::nullopt);
}

TEST(SensorBridge, TenScansAndTwoGasReadingsASecond) {
  FakeDriver driver;
  std::vector<Sample> samples;
  SensorBridge bridge(driver, {.scan_hz = 10.0, .gas_hz = 2.0}, {}, Into(samples));

  for (int tick = 0; tick < 1000; ++tick) {
    ASSERT_TRUE(bridge.Poll().ok());
    ASSERT_TRUE(driver.Advance(0.01).ok());
  }

  EXPECT_EQ(CountScans(samples), 100);
  EXPECT_THAT(samples, SizeIs(120));
  EXPECT_EQ(bridge.scans_taken(), 100);
}

TEST(SensorBridge, SamplesCarryThePoseAndTimeAtWhichTheyWereTaken) {
  FakeDriver driver;
  std::vector<Sample> samples;
  SensorBridge bridge(driver, {.scan_hz = 10.0, .gas_hz = 0.0}, {}, Into(samples));
  const std::int64_t start_ns = driver.now_ns();
  ASSERT_TRUE(driver.Drive({.forward_mps = 1.0}).ok());

  ASSERT_TRUE(bridge.Poll().ok());
  ASSERT_TRUE(driver.Advance(0.1).ok());
  ASSERT_TRUE(bridge.Poll().ok());

  ASSERT_THAT(samples, SizeIs(2));
  EXPECT_EQ(samples[1].time_ns, start_ns + kSecond_ns / 10);
  EXPECT_NEAR(samples[0].pose.x_m, 0.0, 1e-12);
  EXPECT_NEAR(samples[1].pose.x_m, 0.1, 1e-12);
  EXPECT_EQ(bridge.latest_scan_pose(), samples[1].pose);
}

TEST(SensorBridge, ASilentSensorIsCountedAndPassedOver) {
  FakeDriver driver;
  driver.gas_status = absl::UnavailableError("warming up");
  std::vector<Sample> samples;
  SensorBridge bridge(driver, {}, {}, Into(samples));

  EXPECT_TRUE(bridge.Poll().ok());

  EXPECT_THAT(samples, SizeIs(1));
  EXPECT_EQ(bridge.readings_missed(), 1);
}

TEST(SensorBridge, ABrokenSensorIsAnError) {
  FakeDriver driver;
  driver.scan_status = absl::InternalError("no laser");
  std::vector<Sample> samples;
  SensorBridge bridge(driver, {}, {}, Into(samples));

  EXPECT_EQ(bridge.Poll(), absl::InternalError("no laser"));
}

// Stands from `from_s` on until `to_s`; 10 s of ticks of 0.1 s.
std::vector<Sample> StopAndSample(FakeDriver& driver, const GasSampling& sampling, double from_s,
                                  double to_s) {
  std::vector<Sample> samples;
  SensorBridge bridge(driver, {.scan_hz = 0.0, .gas_hz = 2.0}, sampling, Into(samples));
  for (int tick = 0; tick < 100; ++tick) {
    const double now_s = 0.1 * tick + 0.05;
    EXPECT_TRUE(bridge.Poll(now_s > from_s && now_s < to_s).ok());
    EXPECT_TRUE(driver.Advance(0.1).ok());
  }
  return samples;
}

TEST(SensorBridge, OnlySettledReadingsCountIfTheSensorIsSlow) {
  FakeDriver driver;
  const std::int64_t start_ns = driver.now_ns();
  const auto samples = StopAndSample(driver, {.settling_s = 4.0}, 2.3, 7.3);

  ASSERT_THAT(samples, SizeIs(2));  // the stop begins at 2.3 s and its readings with it
  EXPECT_EQ(samples[0].time_ns, start_ns + 63 * kSecond_ns / 10);
  EXPECT_EQ(samples[1].time_ns, start_ns + 68 * kSecond_ns / 10);
}

TEST(SensorBridge, ARobotThatNeverStandsLongEnoughHasNoSettledReading) {
  FakeDriver driver;
  EXPECT_THAT(StopAndSample(driver, {.settling_s = 4.0}, 2.3, 6.2), SizeIs(0));
}

TEST(SensorBridge, ACorrectionComesBeforeWhatIsSensedAfterIt) {
  FakeDriver driver;
  std::vector<ObservationPayload> payloads;
  SensorBridge bridge(driver, SensorRates{}, GasSampling{},
                      [&payloads](std::int64_t, const Pose2&, ObservationPayload payload) {
                        payloads.push_back(std::move(payload));
                      });
  driver.correction = PoseCorrection{{{driver.now_ns(), {1.0, 0.0, 0.0}}}};
  const PoseCorrection correction = *driver.correction;

  ASSERT_TRUE(bridge.Poll().ok());

  ASSERT_THAT(payloads, SizeIs(3));
  EXPECT_EQ(payloads[0], ObservationPayload(correction));
  ASSERT_TRUE(driver.Advance(1.0).ok());
  ASSERT_TRUE(bridge.Poll().ok());
  EXPECT_THAT(payloads, SizeIs(5));
}

}  // namespace sensor_bridge_test
}  // namespace plumescout::client
