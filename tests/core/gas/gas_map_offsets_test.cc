// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Sensors with unknown offsets: what the field makes of them.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/gas/gas_map.h"
#include "tests/core/gas/dense_field.h"
#include "tests/support/same_bytes.h"

namespace plumescout {
namespace gas_map_offsets_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kOffset_ppm = 3.0;
const ReadingSource kReference = {"r1", "pid", 0.0};
const ReadingSource kUnsure = {"r2", "pid", 2.0};

double Truth_ppm(Point2 place) { return 4.0 + 2.0 * std::sin(place.x_m) + place.y_m; }

Grid<CellState> Hall() {
  GridGeometry geometry;
  geometry.resolution_m = 0.25;
  geometry.width = 20;
  geometry.height = 16;
  return Grid<CellState>(geometry, CellState::kFree);
}

// Both drive to and fro; the second also over the first one's ground if they cross. Its readings
// are too high by `offset_ppm`.
GasMap Drive(bool cross, double offset_ppm, const ReadingSource& second) {
  GasMap map{PublishedGasOptions()};
  Rng rng(7);
  for (int i = 0; i < 160; ++i) {
    const double x_m = 0.1 + 4.8 * (i % 40) / 40.0;
    const Point2 a = {x_m, 0.3 + (cross ? 0.95 : 0.3) * (i / 40)};
    const Point2 b = {x_m, a.y_m + (cross ? 0.4 : 2.4)};
    const double read_a_ppm = Truth_ppm(a) + rng.Uniform(-0.3, 0.3);
    const double read_b_ppm = Truth_ppm(b) + rng.Uniform(-0.3, 0.3) + offset_ppm;
    map.AddFrom(kReference, i * kSecond_ns, a, {read_a_ppm, 0.1});
    map.AddFrom(second, i * kSecond_ns, b, {read_b_ppm, 0.1});
  }
  EXPECT_TRUE(map.Refresh(Hall(), 200 * kSecond_ns).ok());
  return map;
}

double Error_ppm(const GasMap& map) {
  double squares = 0.0;
  const Grid<float>& mean_ppm = map.mean_ppm();
  for (std::size_t i = 0; i < mean_ppm.size(); ++i) {
    const Cell cell = mean_ppm.geometry().CellAtIndex(i);
    const double error_ppm = mean_ppm[i] - Truth_ppm(mean_ppm.geometry().Center(cell));
    squares += error_ppm * error_ppm;
  }
  return std::sqrt(squares / static_cast<double>(mean_ppm.size()));
}

TEST(GasMapOffsetsTest, WaysThatCrossTellTheOffset) {
  const GasMap map = Drive(/*cross=*/true, kOffset_ppm, kUnsure);
  ASSERT_EQ(map.sensor_offsets().size(), 1U);
  const SensorOffset& offset = map.sensor_offsets()[0];
  EXPECT_TRUE(offset.estimated);
  EXPECT_FALSE(offset.drifting);
  EXPECT_NEAR(offset.offset_ppm, kOffset_ppm, 4.0 * offset.stddev_ppm);
  EXPECT_LT(offset.stddev_ppm, 0.2);
  const double calibrated_ppm = Error_ppm(Drive(true, 0.0, {"r2", "pid", 0.0}));
  const double ignored_ppm = Error_ppm(Drive(true, kOffset_ppm, {"r2", "pid", 0.0}));
  EXPECT_LT(Error_ppm(map), 1.2 * calibrated_ppm);
  EXPECT_GT(ignored_ppm, 1.5 * calibrated_ppm);
}

TEST(GasMapOffsetsTest, WithoutCrossingsReadingsAreTakenAsTheyAre) {
  const GasMap map = Drive(/*cross=*/false, kOffset_ppm, kUnsure);
  EXPECT_FALSE(map.sensor_offsets()[0].estimated);
  EXPECT_EQ(map.sensor_offsets()[0].stddev_ppm, kUnsure.offset_stddev_ppm);
  const GasMap plain = Drive(false, kOffset_ppm, {"r2", "pid", 0.0});
  EXPECT_TRUE(support::SameBytes(map.mean_ppm(), plain.mean_ppm()));
  EXPECT_TRUE(support::SameBytes(map.variance_ppm2(), plain.variance_ppm2()));
}

TEST(GasMapOffsetsTest, TheFieldIsLessSureForOffsets) {
  const GasMap map = Drive(true, kOffset_ppm, kUnsure);
  const GasMap sure = Drive(true, 0.0, {"r2", "pid", 0.0});
  for (std::size_t i = 0; i < map.variance_ppm2().size(); ++i) {
    EXPECT_GE(map.variance_ppm2()[i], sure.variance_ppm2()[i]);
  }
}

// What planning weighs: variances before and after come of one field.
TEST(GasMapOffsetsTest, WhatReadingsWouldTellIsReckonedFromThatField) {
  const GasMap map = Drive(true, kOffset_ppm, kUnsure);
  EXPECT_TRUE(support::SameBytes(map.what_if()->variance_ppm2(), map.variance_ppm2()));
  const Cell read = {10, 12};
  const auto after = map.what_if()->VarianceIfRead({&read, 1}, 10.0);
  ASSERT_TRUE(after.ok());
  for (std::size_t i = 0; i < after->size(); ++i) {
    EXPECT_LE((*after)[i], map.variance_ppm2()[i] * (1.0F + 1e-5F));
  }
  EXPECT_LT((*after)[read], 0.9F * map.variance_ppm2()[read]);
}

// Sensors meet often enough after a refresh that only one of two maps was looked at since.
TEST(GasMapOffsetsTest, WhoLooksOnChangesNothing) {
  GasMap seen{PublishedGasOptions()};
  GasMap unseen{PublishedGasOptions()};
  for (int i = 0; i < 60; ++i) {
    for (GasMap* const map : {&seen, &unseen}) {
      const Point2 place = {0.2 + 0.05 * i, 1.0};
      map->AddFrom(kReference, i * kSecond_ns, place, {3.0, 0.1});
      map->AddFrom(kUnsure, i * kSecond_ns, place, {7.0, 0.1});
      if (i != 15) continue;
      ASSERT_TRUE(map->Refresh(Hall(), i * kSecond_ns).ok());
    }
    seen.mean_ppm();
  }
  ASSERT_TRUE(seen.sensor_offsets()[0].estimated);
  EXPECT_EQ(seen.sensor_offsets(), unseen.sensor_offsets());
  EXPECT_TRUE(support::SameBytes(seen.mean_ppm(), unseen.mean_ppm()));
  EXPECT_TRUE(support::SameBytes(seen.variance_ppm2(), unseen.variance_ppm2()));
  EXPECT_EQ(seen.quality(), unseen.quality());
}

}  // namespace gas_map_offsets_test
}  // namespace plumescout
