// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/streams/map_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace plumescout::server {
namespace map_frames_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// 100 x 80 cells: two columns of tiles and two rows, the upper and right ones cut.
MapSnapshot TestMap() {
  const GridGeometry geometry{0.0, 0.0, 0.1, 100, 80};
  MapSnapshot map;
  map.revision = 10;
  map.occupancy = Grid<CellState>(geometry, CellState::kUnknown);
  map.gas_mean_ppm = Grid<float>(geometry, kNan);
  map.gas_variance_ppm2 = map.gas_mean_ppm;
  return map;
}

MapSnapshot Later(const MapSnapshot& map) {
  MapSnapshot later = map;
  ++later.revision;
  return later;
}

TEST(MapFramesTest, NewReaderGetsEverything) {
  const auto frames = FramesBetween(nullptr, TestMap(), "hall", {});
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].kind(), v1::WatchMapResponse::KIND_FULL);
  EXPECT_EQ(frames[0].revision(), 10);
  EXPECT_EQ(frames[0].tiles_size(), 3);
  EXPECT_EQ(frames[0].tiles(0).column_count(), 100);
}

TEST(MapFramesTest, ReaderWhoIsUpToDateGetsNothing) {
  const MapSnapshot map = TestMap();
  EXPECT_TRUE(FramesBetween(&map, map, "hall", {}).empty());
}

TEST(MapFramesTest, OnlyTilesThatDifferAreSent) {
  const MapSnapshot before = TestMap();
  MapSnapshot now = Later(before);
  now.occupancy[Cell{99, 3}] = CellState::kFree;
  const auto frames = FramesBetween(&before, now, "hall", {});
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].kind(), v1::WatchMapResponse::KIND_DELTA);
  EXPECT_EQ(frames[0].base_revision(), 10);
  EXPECT_EQ(frames[0].revision(), 11);
  ASSERT_EQ(frames[0].tiles_size(), 3);  // one tile, three layers
  EXPECT_EQ(frames[0].tiles(0).min_cell().column(), 64);
  EXPECT_EQ(frames[0].tiles(0).min_cell().row(), 0);
  EXPECT_EQ(frames[0].tiles(0).column_count(), 36);
  EXPECT_EQ(frames[0].tiles(0).row_count(), 64);
}

TEST(MapFramesTest, DeltaTurnsTheOldMapIntoTheNew) {
  const MapSnapshot before = TestMap();
  MapSnapshot now = Later(before);
  now.occupancy[Cell{5, 5}] = CellState::kFree;
  now.gas_mean_ppm[Cell{5, 5}] = 3.25f;
  now.gas_mean_ppm[Cell{70, 79}] = 1.5f;
  MapSnapshot reader = before;
  for (const auto& frame : FramesBetween(&before, now, "hall", {.full_precision = true})) {
    for (const auto& tile : frame.tiles()) ASSERT_TRUE(DecodeTile(tile, "tile", reader).ok());
  }
  EXPECT_EQ(reader.occupancy, now.occupancy);
  EXPECT_EQ((reader.gas_mean_ppm[Cell{5, 5}]), 3.25f);
  EXPECT_EQ((reader.gas_mean_ppm[Cell{70, 79}]), 1.5f);
  EXPECT_TRUE(std::isnan((reader.gas_mean_ppm[Cell{6, 5}])));
}

TEST(MapFramesTest, LayersNobodyAskedForDoNotCount) {
  const MapSnapshot before = TestMap();
  MapSnapshot now = Later(before);
  now.gas_mean_ppm[Cell{5, 5}] = 3.25f;
  const MapView occupancy_only{.occupancy = true, .gas_mean = false, .gas_variance = false};
  const auto frames = FramesBetween(&before, now, "hall", occupancy_only);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].kind(), v1::WatchMapResponse::KIND_PROGRESS);
}

TEST(MapFramesTest, StatusAloneIsProgress) {
  const MapSnapshot before = TestMap();
  MapSnapshot now = Later(before);
  now.phase = MissionPhase::kComplete;
  const auto frames = FramesBetween(&before, now, "hall", {});
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].kind(), v1::WatchMapResponse::KIND_PROGRESS);
  EXPECT_EQ(frames[0].tiles_size(), 0);
  EXPECT_EQ(frames[0].status().phase(), v1::MISSION_PHASE_COMPLETE);
}

TEST(MapFramesTest, MapThatGrewIsResetAndSentWhole) {
  const MapSnapshot before = TestMap();
  MapSnapshot now = Later(before);
  now.occupancy = Grid<CellState>({-6.4, 0.0, 0.1, 164, 80}, CellState::kUnknown);
  now.gas_mean_ppm = Grid<float>(now.occupancy.geometry(), kNan);
  now.gas_variance_ppm2 = now.gas_mean_ppm;
  const auto frames = FramesBetween(&before, now, "hall", {});
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].kind(), v1::WatchMapResponse::KIND_RESET);
  EXPECT_EQ(frames[1].kind(), v1::WatchMapResponse::KIND_FULL);
  EXPECT_EQ(frames[1].status().geometry().column_count(), 164);
}

}  // namespace map_frames_test
}  // namespace plumescout::server
