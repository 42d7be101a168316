// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/way_readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/gas/way_state.h"
#include "core/types/byte_archive.h"
#include "core/types/byte_reader.h"
#include "core/types/rng.h"

namespace plumescout {
namespace way_readings_test {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kHalfSecond_ns = 500'000'000;
constexpr double kVariance_ppm2 = 0.1;  // 1 / lambda_o

WayModel Model(double response_time_s = 0.5) {
  WayModel model;
  model.response_time_s = response_time_s;
  model.gas = PublishedGasOptions();
  return model;
}

// At 0.4 m/s along x: three cells between readings, for 0.125, 0.25 and 0.125 s.
Pose2 PoseAt(int reading) { return {0.05 + 0.2 * reading, 0.05, 0.0}; }
constexpr double kStays_s[] = {0.125, 0.25, 0.125};
constexpr std::size_t kCells = std::size(kStays_s);

// What the model says of all air and of the sensor at the beginning, by dense algebra: unknown are
// c_0, x_0 and the air of each stay.
std::vector<double> DenseAir(const std::vector<double>& shown_ppm, double response_time_s) {
  const std::size_t intervals = shown_ppm.size() - 1;
  const auto n = static_cast<Eigen::Index>(2 + kCells * intervals);
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd information = Eigen::VectorXd::Zero(n);
  const auto observe = [&](const Eigen::VectorXd& row, double value, double variance) {
    precision += row * row.transpose() / variance;
    information += row * value / variance;
  };
  const auto unit = [n](Eigen::Index i) -> Eigen::VectorXd { return Eigen::VectorXd::Unit(n, i); };
  const auto noise = [](double z) { return kVariance_ppm2 + 0.05 * z * 0.05 * z; };
  const double first_ppm = shown_ppm[0];
  const double sigma_ppm = std::sqrt(kVariance_ppm2);
  observe(unit(0), first_ppm, noise(first_ppm));
  observe(unit(1), first_ppm, (first_ppm + sigma_ppm) * (first_ppm + sigma_ppm));
  Eigen::VectorXd sensor = unit(0);
  Eigen::Index at = 1;
  for (std::size_t k = 1; k <= intervals; ++k) {
    const double level_ppm = std::max(shown_ppm[k], shown_ppm[k - 1]) + sigma_ppm;
    for (const double stay_s : kStays_s) {
      const double way_m = 0.4 * stay_s + 0.5 * stay_s;  // driven, and drifted by
      observe(unit(at + 1) - unit(at), 0.0, 0.09 * level_ppm * level_ppm * way_m / 0.1);
      ++at;
      const double kept = std::exp(-stay_s / response_time_s);
      sensor = kept * sensor + (1.0 - kept) * unit(at);
    }
    observe(sensor, shown_ppm[k], noise(shown_ppm[k]));
  }
  const Eigen::VectorXd mean = precision.ldlt().solve(information);
  return {mean.data() + 2, mean.data() + n};
}

TEST(WayReadingsTest, TellsTheAirThatAllReadingsUpToTheNextOneSay) {
  for (const double response_time_s : {0.1, 0.5, 4.0}) {
    SCOPED_TRACE(response_time_s);
    const std::vector<double> shown_ppm = {2.0, 2.5, 6.0, 14.0, 9.0, 9.5, 8.0};
    const WayModel model = Model(response_time_s);
    WayReadings way;
    for (std::size_t k = 0; k < shown_ppm.size(); ++k) {
      const auto reading = static_cast<int>(k);
      const std::vector<AirReading> told =
          way.Add(model, reading * kHalfSecond_ns, PoseAt(reading), {shown_ppm[k], 0.0, 0});
      if (k < 2) {
        ASSERT_THAT(told, SizeIs(k == 0 ? 1 : 0));
        continue;
      }
      const std::vector<double> air_ppm =
          DenseAir({shown_ppm.begin(), shown_ppm.begin() + reading + 1}, response_time_s);
      ASSERT_THAT(told, SizeIs(kCells));
      for (std::size_t i = 0; i < kCells; ++i) {
        const double expected_ppm = std::max(0.0, air_ppm[(k - 2) * kCells + i]);
        EXPECT_NEAR(told[i].reading.concentration_ppm, expected_ppm, 1e-6);
        EXPECT_NEAR(told[i].reading.variance_ppm2, kVariance_ppm2 * 0.5 / kStays_s[i], 1e-9);
      }
      EXPECT_NEAR(told[1].pose.x_m, PoseAt(reading - 2).x_m + 0.1, 1e-9);
      EXPECT_NEAR(static_cast<double>(told[1].time_ns), (reading - 2 + 0.5) * 5e8, 2.0);
    }
    EXPECT_THAT(way.Finish(model), SizeIs(kCells));
    EXPECT_THAT(way.Finish(model), IsEmpty());
  }
}

// A sensor with this lag, exactly, along x through gas between 1 m and 1.6 m.
double Air_ppm(double x_m) { return x_m >= 1.0 && x_m < 1.6 ? 20.0 : 0.0; }

TEST(WayReadingsTest, PeaksAreWhereTheyAre) {
  constexpr double kSpeed_mps = 1.25;
  constexpr double kStep_s = 0.001;
  const WayModel model = Model();
  WayReadings way;
  double cell_ppm = 0.0;
  double raw_errors = 0.0;
  int raw = 0;
  double told_errors = 0.0;
  double told_weights = 0.0;
  for (int step = 0; step <= 4000; ++step) {
    const double x_m = 0.05 + kSpeed_mps * kStep_s * step;
    const std::int64_t time_ns = step * 1'000'000LL;
    cell_ppm += (Air_ppm(x_m) - cell_ppm) * -std::expm1(-kStep_s / model.response_time_s);
    const Pose2 pose{x_m, 0.05, 0.0};
    if (step % 100 == 0) way.NotePose(time_ns, pose);
    if (step % 500 != 0) continue;
    raw_errors += std::pow(cell_ppm - Air_ppm(x_m), 2);
    ++raw;
    for (const AirReading& air : way.Add(model, time_ns, pose, {cell_ppm})) {
      const double error_ppm = air.reading.concentration_ppm - Air_ppm(air.pose.x_m);
      told_errors += error_ppm * error_ppm / air.reading.variance_ppm2;
      told_weights += 1.0 / air.reading.variance_ppm2;
    }
  }
  EXPECT_LT(std::sqrt(told_errors / told_weights), 0.85 * std::sqrt(raw_errors / raw));
}

TEST(WayReadingsTest, WhereTheRobotStandsSteadyAirIsTheReading) {
  WayReadings way;
  for (int k = 0; k < 5; ++k) {
    const auto told = way.Add(Model(), k * kHalfSecond_ns, {1.05, 1.05, 0.3}, {5.0});
    if (k == 1) continue;
    ASSERT_THAT(told, SizeIs(1));
    EXPECT_NEAR(told[0].reading.concentration_ppm, 5.0, 1e-9);
    EXPECT_NEAR(told[0].reading.variance_ppm2, kVariance_ppm2, 1e-12);
    EXPECT_NEAR(told[0].pose.x_m, 1.05, 1e-12);
  }
}

// One of these comes after two readings: what the second one ended is told, and the reading itself.
TEST(WayReadingsTest, BeginsAnewWhereTheWayIsNotKnown) {
  struct Odd {
    std::int64_t time_ns;
    Pose2 pose;
  };
  for (const Odd& odd : {Odd{kHalfSecond_ns, PoseAt(2)},                 // no later
                         Odd{0, PoseAt(2)},                              // earlier
                         Odd{kHalfSecond_ns * 10, PoseAt(2)},            // 4.5 s later: 9 tau
                         Odd{kHalfSecond_ns * 2, {30.0, 0.0, 0.0}},      // a jump
                         Odd{kHalfSecond_ns * 9, {40.0, 0.05, 0.0}}}) {  // 397 cells
    WayReadings way;
    way.Add(Model(), 0, PoseAt(0), {2.0});
    way.Add(Model(), kHalfSecond_ns, PoseAt(1), {3.0});
    const auto told = way.Add(Model(), odd.time_ns, odd.pose, {7.0});
    ASSERT_THAT(told, SizeIs(kCells + 1));
    EXPECT_EQ(told.back().time_ns, odd.time_ns);
    EXPECT_EQ(told.back().pose, odd.pose);
    EXPECT_EQ(told.back().reading.concentration_ppm, 7.0);
    EXPECT_NEAR(told.back().reading.variance_ppm2, kVariance_ppm2, 1e-12);
    EXPECT_THAT(way.Finish(Model()), IsEmpty());
  }
}

TEST(WayReadingsTest, AnythingThatIsReadStaysWithinReason) {
  for (const double other_ppm : {0.0, 1e6}) {
    WayReadings way;
    for (int k = 0; k < 60; ++k) {
      const double shown_ppm = k % 7 == 3 ? other_ppm : 0.0;
      for (const AirReading& air : way.Add(Model(), k * kHalfSecond_ns, PoseAt(k), {shown_ppm})) {
        EXPECT_GE(air.reading.concentration_ppm, 0.0);
        EXPECT_LE(air.reading.concentration_ppm, 4.0 * other_ppm);
        EXPECT_GT(air.reading.variance_ppm2, 0.0);
        EXPECT_TRUE(std::isfinite(air.reading.variance_ppm2));
      }
    }
  }
}

TEST(WayReadingsTest, GoesOnFromItsBytes) {
  WayReadings way;
  for (int k = 0; k < 4; ++k) way.Add(Model(), k * kHalfSecond_ns, PoseAt(k), {1.0 + k});
  way.NotePose(3 * kHalfSecond_ns + 100'000'000, PoseAt(3));
  ByteWriter writer;
  writer(way);
  WayReadings read;
  ByteReader reader(writer.sink().bytes, 1 << 20);
  reader(read);
  ASSERT_TRUE(reader.Finish().ok());
  EXPECT_EQ(read.Add(Model(), 4 * kHalfSecond_ns, PoseAt(4), {9.0}),
            way.Add(Model(), 4 * kHalfSecond_ns, PoseAt(4), {9.0}));
  EXPECT_EQ(read.Finish(Model()), way.Finish(Model()));
}

TEST(WayReadingsTest, AllButTheFirstOfAReadingAreItsParts) {
  WayReadings way;
  std::vector<AirReading> told = way.Add(Model(), 0, PoseAt(0), {1.0});
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_FALSE(told[0].is_part);
  EXPECT_THAT(way.Add(Model(), kHalfSecond_ns, PoseAt(1), {2.0}), IsEmpty());
  // After a pause that is too long: what was untold, and the reading, as a first one.
  told = way.Add(Model(), 100 * kHalfSecond_ns, PoseAt(2), {3.0});
  ASSERT_THAT(told, SizeIs(kCells + 1));
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].is_part, i != 0 && i != kCells) << i;
  }
}

TEST(WayReadingsTest, WhatIsUntoldStaysSo) {
  WayReadings way;
  EXPECT_THAT(way.Untold(Model()), IsEmpty());
  for (int k = 0; k < 3; ++k) way.Add(Model(), k * kHalfSecond_ns, PoseAt(k), {1.0 + k});
  const std::vector<AirReading> untold = way.Untold(Model());
  EXPECT_THAT(untold, SizeIs(kCells));
  EXPECT_EQ(way.Untold(Model()), untold);
  EXPECT_EQ(way.Finish(Model()), untold);
  EXPECT_THAT(way.Untold(Model()), IsEmpty());
}

// The bytes of a way with three points and an interval of three stays that is not told yet: in
// front the number of points, 32 bytes for each, the latest deviation, the state, and whether
// there is an interval.
class WayStateTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kPoint = sizeof(std::uint32_t);
  static constexpr std::size_t kPointBytes = 32;
  static constexpr std::size_t kLatest = kPoint + 3 * kPointBytes;

  void SetUp() override {
    WayReadings way;
    for (int k = 0; k < 3; ++k) way.Add(Model(), k * kHalfSecond_ns, PoseAt(k), {1.0 + k});
    for (int i = 1; i < 3; ++i) {
      way.NotePose(2 * kHalfSecond_ns + i * 100'000'000, PoseAt(2));
    }
    ByteWriter writer;
    writer(way);
    bytes_ = writer.sink().bytes;
  }
  bool IsTaken(std::string bytes) {
    WayReadings way;
    ByteReader reader(bytes, 1 << 20);
    reader(way);
    return reader.Finish().ok();
  }
  template <typename T>
  std::string With(std::size_t at, T value) {
    std::string bytes = bytes_;
    std::memcpy(bytes.data() + at, &value, sizeof(value));
    return bytes;
  }

  std::string bytes_;
};

TEST_F(WayStateTest, WhatNoSensorHasReadIsRefused) {
  ASSERT_TRUE(IsTaken(bytes_));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double is : {nan, inf, -inf}) {
    EXPECT_FALSE(IsTaken(With(kPoint + 8, is))) << "x of a point";
    EXPECT_FALSE(IsTaken(With(kPoint + 24, is))) << "yaw of a point";
    EXPECT_FALSE(IsTaken(With(kLatest, is))) << "the latest deviation";
  }
  EXPECT_FALSE(IsTaken(With(kPoint + kPointBytes, std::int64_t{0}))) << "times do not ascend";
  EXPECT_TRUE(IsTaken(With(kPoint, std::int64_t{0}))) << "any time may be the first";
}

// Whatever double stands in the state and in the interval, it is refused or leads to readings that
// a store can take.
TEST_F(WayStateTest, WhatIsTakenTellsReadings) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  int refused = 0;
  for (std::size_t at = kLatest; at + sizeof(double) <= bytes_.size(); ++at) {
    for (const double is : {nan, -1.0, 1e300}) {
      const std::string bytes = With(at, is);
      WayReadings way;
      ByteReader reader(bytes, 1 << 20);
      reader(way);
      if (!reader.Finish().ok()) {
        ++refused;
        continue;
      }
      for (const AirReading& air : way.Finish(Model())) {
        EXPECT_TRUE(std::isfinite(air.pose.x_m)) << at;
        EXPECT_GE(air.reading.concentration_ppm, 0.0) << at;
        EXPECT_GE(air.reading.variance_ppm2, 0.0) << at;
      }
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace way_readings_test
}  // namespace plumescout
