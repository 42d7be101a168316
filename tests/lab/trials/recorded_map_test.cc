// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/recorded_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout::lab {
namespace recorded_map_test {

constexpr double kAir_ppm = 5.0;
constexpr double kLag_s = 0.5;

// Through a corridor of 6 m at 1 m/s, twice a second a reading; its sensor follows air of 5 ppm
// that begins at x = 3 m.
GasRecording Corridor() {
  GasRecording recording;
  recording.states = Grid<CellState>(GridGeometry{0.0, 0.0, 0.1, 60, 5}, CellState::kFree);
  recording.response_time_s = kLag_s;
  for (int i = 0; i <= 10; ++i) {
    const double time_s = 0.5 * i;
    const double x_m = 0.55 + time_s;
    HeardPose& heard = recording.heard.emplace_back();
    heard.time_ns = std::int64_t{500'000'000} * i;
    heard.pose = {x_m, 0.25, 0.0};
    const double within_s = x_m - 3.0;
    const double shown = within_s > 0.0 ? kAir_ppm * (1.0 - std::exp(-within_s / kLag_s)) : 0.0;
    heard.reading = GasReading{.concentration_ppm = shown};
  }
  return recording;
}

TEST(RecordedMap, PointsHaveTheLagUndone) {
  const std::vector<PlacedReading> placed = AtPoints(Corridor());
  ASSERT_GE(placed.size(), 8u);
  for (const PlacedReading& reading : placed) {
    const double x_m = reading.place.x_m;
    if (x_m < 2.5) {
      EXPECT_NEAR(reading.reading.concentration_ppm, 0.0, 1e-9);
    } else if (x_m > 3.6) {
      EXPECT_NEAR(reading.reading.concentration_ppm, kAir_ppm, 0.2);
    }
  }
}

TEST(RecordedMap, WaysHaveMoreCellsThanReadings) {
  const GasRecording recording = Corridor();
  EXPECT_GT(AlongWay(recording, GasOptions{}).size(), recording.heard.size());
}

TEST(RecordedMap, IsTheFieldOfTheReadingsOverTheKnownCells) {
  GasRecording recording = Corridor();
  recording.states[Cell{59, 4}] = CellState::kUnknown;
  for (const bool learns : {false, true}) {
    GasOptions gas;
    if (learns) gas.precisions = GasPrecisions::kLearned;
    const auto map = MapRecording(recording, AtPoints(recording), gas);
    ASSERT_TRUE(map.ok()) << map.status();
    EXPECT_EQ(map->occupancy, recording.states);
    const auto mean_at = [&](double x_m) {
      return map->gas_mean_ppm.At(map->gas_mean_ppm.geometry().CellAt({x_m, 0.25}), NAN);
    };
    EXPECT_NEAR(mean_at(1.05), 0.0, 0.5);
    EXPECT_NEAR(mean_at(4.55), kAir_ppm, 1.0);
    EXPECT_TRUE(
        std::isnan(map->gas_mean_ppm.At(map->gas_mean_ppm.geometry().CellAt({5.95, 0.45}), NAN)));
    EXPECT_GE(map->gas_quality.noise_scale, 1.0);
  }
}

}  // namespace recorded_map_test
}  // namespace plumescout::lab
