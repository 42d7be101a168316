// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/sensor_offsets.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/gas/gas_state.h"
#include "core/types/byte_reader.h"

namespace plumescout {
namespace sensor_offsets_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kResolution_m = 0.1;
const ReadingSource kReference = {"r1", "pid", 0.0};
const ReadingSource kUnsure = {"r2", "pid", 2.0};

Grid<CellState> Free(int width, int height) {
  return Grid<CellState>({0.0, 0.0, kResolution_m, width, height}, CellState::kFree);
}

std::vector<std::size_t> All(const Grid<CellState>& states) {
  std::vector<std::size_t> all(states.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

// Both read in the same place, `times` times.
void Meet(SensorOffsets& sensors, int times, const GridGeometry& anchor = {}) {
  for (int i = 0; i < times; ++i) {
    sensors.Add(kReference, i * kSecond_ns, {0.25, 0.25}, {5.0, 0.5}, anchor);
    sensors.Add(kUnsure, i * kSecond_ns, {0.35, 0.25}, {7.0, 0.5}, anchor);
  }
}

TEST(SensorOffsetsTest, TellsOfSensorsWithUnknownOffsetsOnly) {
  SensorOffsets sensors(GasOptions(), kResolution_m);
  EXPECT_TRUE(sensors.empty());
  Meet(sensors, 3);
  EXPECT_FALSE(sensors.empty());
  const std::vector<SensorOffset> known = sensors.Known();
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known[0].robot, "r2");
  EXPECT_EQ(known[0].sensor, "pid");
  EXPECT_EQ(known[0].stddev_ppm, 2.0);
  EXPECT_EQ(known[0].crossings, 5);  // the first of all met nobody
  EXPECT_FALSE(known[0].estimated);
}

TEST(SensorOffsetsTest, ASensorIsAColumnOnceItMetAnotherOftenEnough) {
  SensorOffsets sensors(GasOptions(), kResolution_m);
  Meet(sensors, 5);
  EXPECT_FALSE(sensors.HasColumns());
  Meet(sensors, 10);
  ASSERT_TRUE(sensors.HasColumns());
  const Grid<CellState> states = Free(8, 8);
  ASSERT_TRUE(sensors.Place(states, All(states)).ok());
  const std::vector<SensorOffsets::Column> columns = sensors.Columns();
  ASSERT_EQ(columns.size(), 1U);
  EXPECT_EQ(columns[0].sensor, 0U);
  EXPECT_DOUBLE_EQ(columns[0].prior_precision_per_ppm2, 0.25);
  ASSERT_EQ(columns[0].cells.size(), 1U);
  EXPECT_EQ(columns[0].cells[0].cell, (AnchorCell{3, 2}));
  EXPECT_NEAR(columns[0].cells[0].evidence.precision, 15 / 0.5, 1e-9);
  EXPECT_NEAR(columns[0].cells[0].evidence.weighted_deviation, 15 * 7.0 / 0.5, 1e-9);
}

TEST(SensorOffsetsTest, EstimatesThoseThatWereHeardFirstOfVeryMany) {
  SensorOffsets sensors(GasOptions(), kResolution_m);
  constexpr std::size_t kSensors = SensorOffsets::kMostColumns + 3;
  for (int i = 0; i < 30; ++i) {
    sensors.Add(kReference, i * kSecond_ns, {0.25, 0.25}, {5.0, 0.5}, {});
    for (std::size_t k = 0; k < kSensors; ++k) {
      const ReadingSource source{"r2", "pid" + std::to_string(k), 2.0};
      sensors.Add(source, i * kSecond_ns, {0.35, 0.25}, {7.0, 0.5}, {});
    }
  }
  EXPECT_EQ(sensors.Known().size(), kSensors);
  const std::vector<SensorOffsets::Column> columns = sensors.Columns();
  ASSERT_EQ(columns.size(), SensorOffsets::kMostColumns);
  EXPECT_EQ(columns.back().sensor, SensorOffsets::kMostColumns - 1);
}

TEST(SensorOffsetsTest, ASensorThatIsCalibratedMeanwhileIsNoColumn) {
  SensorOffsets sensors(GasOptions(), kResolution_m);
  Meet(sensors, 20);
  sensors.Add({"r2", "pid", 0.0}, 30 * kSecond_ns, {0.35, 0.25}, {7.0, 0.5}, {});
  EXPECT_FALSE(sensors.HasColumns());
  EXPECT_TRUE(sensors.Known().empty());
}

// The map had grown to the west when the sensor came.
TEST(SensorOffsetsTest, ALateSensorCountsCellsAsTheFieldDoes) {
  SensorOffsets sensors(GasOptions(), kResolution_m);
  const GridGeometry anchor = {0.2, 0.2, kResolution_m, 4, 4};
  Meet(sensors, 20, anchor);
  const Grid<CellState> states = Free(8, 8);
  ASSERT_TRUE(sensors.Place(states, All(states)).ok());
  ASSERT_EQ(sensors.Columns()[0].cells.size(), 1U);
  EXPECT_EQ(sensors.Columns()[0].cells[0].cell, (AnchorCell{1, 0}));
}

TEST(SensorOffsetsTest, SurvivesAsBytes) {
  SensorOffsets sensors(GasOptions(), kResolution_m);
  AnchoredStates states;
  const Grid<CellState> grid = Free(8, 8);
  ASSERT_TRUE(states.Update(grid).ok());
  Meet(sensors, 20);
  ASSERT_TRUE(sensors.Place(grid, All(grid)).ok());
  Meet(sensors, 2);  // not placed yet
  ByteWriter writer;
  writer(sensors);
  const std::string bytes = writer.sink().bytes;

  SensorOffsets read(GasOptions(), kResolution_m);
  ByteReader reader(bytes, 1 << 20);
  reader(read);
  ASSERT_TRUE(reader.Finish().ok());
  ASSERT_TRUE(read.PlaceAgain(states));
  EXPECT_EQ(read.Known(), sensors.Known());
  EXPECT_EQ(read.sites(), sensors.sites());
  EXPECT_EQ(read.Columns()[0].cells.size(), sensors.Columns()[0].cells.size());
  ByteWriter again;
  again(read);
  EXPECT_EQ(again.sink().bytes, bytes);
}

}  // namespace sensor_offsets_test
}  // namespace plumescout
