// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/layer_tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "proto/convert/map.h"
#include "server/maps/level_of_detail.h"
#include "tests/server/maps/random_map.h"

namespace plumescout::server {
namespace layer_tiles_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// 100 x 80 cells: two columns of tiles and two rows, the upper and right ones cut.
class LayerTilesTest : public testing::Test {
 protected:
  LayerTilesTest() { Show(10, Grid<CellState>(geometry_), Grid<float>(geometry_, kNan)); }

  void Show(std::int64_t revision, const Grid<CellState>& states, const Grid<float>& mean) {
    rasters_.revision = revision;
    rasters_.occupancy = {std::make_shared<const Grid<CellState>>(states), revision};
    rasters_.gas_mean_ppm = {std::make_shared<const Grid<float>>(mean), revision};
    rasters_.gas_variance_ppm2 = rasters_.gas_mean_ppm;
  }
  static v1::MapTile Read(const StoredTile& tile) {
    v1::MapTile proto;
    EXPECT_TRUE(proto.ParseFromArray(tile.bytes.begin(), static_cast<int>(tile.bytes.size())));
    return proto;
  }

  const GridGeometry geometry_{0.0, 0.0, 0.1, 100, 80};
  MapRasters rasters_;
};

TEST_F(LayerTilesTest, UnknownTileHasNoBytes) {
  LayerTiles states({v1::MAP_LAYER_OCCUPANCY, false, 0}, geometry_);
  LayerTiles mean({v1::MAP_LAYER_GAS_MEAN, true, 3}, geometry_);
  EXPECT_EQ(states.column_count(), 2);
  EXPECT_EQ(states.row_count(), 2);
  EXPECT_EQ(mean.column_count(), 1);
  EXPECT_EQ(states.At({1, 1}, rasters_).bytes.size(), 0u);
  EXPECT_EQ(mean.At({0, 0}, rasters_).bytes.size(), 0u);
}

TEST_F(LayerTilesTest, TileIsEncodedAnewOnlyWhenItsCellsChange) {
  LayerTiles tiles({v1::MAP_LAYER_OCCUPANCY, false, 0}, geometry_);
  Grid<CellState> states(geometry_);
  states[Cell{99, 3}] = CellState::kFree;
  Show(11, states, Grid<float>(geometry_, kNan));
  const v1::MapTile first = Read(tiles.At({1, 0}, rasters_));
  EXPECT_EQ(first.min_cell().column(), 64);
  EXPECT_EQ(first.column_count(), 36);
  EXPECT_EQ(first.row_count(), 64);
  tiles.At({0, 0}, rasters_);
  EXPECT_EQ(tiles.encoded_count(), 2);

  states[Cell{5, 5}] = CellState::kOccupied;  // of another tile
  Show(12, states, Grid<float>(geometry_, kNan));
  const grpc::Slice before = tiles.At({1, 0}, rasters_).bytes;
  EXPECT_EQ(tiles.At({1, 0}, rasters_).since, 11);
  EXPECT_EQ(tiles.encoded_count(), 2);
  EXPECT_EQ(tiles.At({0, 0}, rasters_).since, 12);
  EXPECT_EQ(tiles.encoded_count(), 3);

  states[Cell{99, 3}] = CellState::kOccupied;
  Show(13, states, Grid<float>(geometry_, kNan));
  const StoredTile after = tiles.At({1, 0}, rasters_);
  EXPECT_EQ(after.since, 13);
  EXPECT_NE(std::string(before.begin(), before.end()),
            std::string(after.bytes.begin(), after.bytes.end()));
}

TEST_F(LayerTilesTest, TileThatIsUnknownAgainHasChanged) {
  LayerTiles tiles({v1::MAP_LAYER_GAS_MEAN, false, 0}, geometry_);
  Grid<float> mean(geometry_, kNan);
  mean[Cell{1, 1}] = 2.0f;
  Show(11, Grid<CellState>(geometry_), mean);
  EXPECT_GT(tiles.At({0, 0}, rasters_).bytes.size(), 0u);
  Show(12, Grid<CellState>(geometry_), Grid<float>(geometry_, kNan));
  EXPECT_EQ(tiles.At({0, 0}, rasters_).bytes.size(), 0u);
  EXPECT_EQ(tiles.At({0, 0}, rasters_).since, 12);
}

TEST_F(LayerTilesTest, ChangeThatTheFormDoesNotShowIsNone) {
  LayerTiles coarse({v1::MAP_LAYER_GAS_MEAN, true, 2}, geometry_);
  Grid<float> mean(geometry_, kNan);
  mean[Cell{1, 1}] = 2.0f;
  Show(11, Grid<CellState>(geometry_), mean);
  coarse.At({0, 0}, rasters_);
  mean[Cell{2, 2}] = 1.0f;  // less than another of its square
  Show(12, Grid<CellState>(geometry_), mean);
  EXPECT_EQ(coarse.At({0, 0}, rasters_).since, 11);
}

TEST_F(LayerTilesTest, FormsHaveTheirEncodings) {
  Grid<float> mean(geometry_, kNan);
  mean[Cell{1, 1}] = 2.0f;
  Show(11, Grid<CellState>(geometry_), mean);
  LayerTiles scaled({v1::MAP_LAYER_GAS_MEAN, false, 0}, geometry_);
  LayerTiles full({v1::MAP_LAYER_GAS_VARIANCE, true, 0}, geometry_);
  EXPECT_EQ(Read(scaled.At({0, 0}, rasters_)).encoding(), v1::MapTile::ENCODING_U16_SCALED);
  EXPECT_EQ(Read(full.At({0, 0}, rasters_)).encoding(), v1::MapTile::ENCODING_F32);
  EXPECT_EQ(Read(full.At({0, 0}, rasters_)).layer(), v1::MAP_LAYER_GAS_VARIANCE);
}

TEST_F(LayerTilesTest, UnknownTileClearsWhatAReaderHolds) {
  MapSnapshot map;
  map.occupancy = Grid<CellState>(geometry_, CellState::kFree);
  map.gas_mean_ppm = Grid<float>(geometry_, 1.0f);
  map.gas_variance_ppm2 = map.gas_mean_ppm;
  const auto rect = CellRect::Sized({64, 64}, 36, 16);
  for (const v1::MapLayer layer :
       {v1::MAP_LAYER_OCCUPANCY, v1::MAP_LAYER_GAS_MEAN, v1::MAP_LAYER_GAS_VARIANCE}) {
    const v1::MapTile tile = Read({0, UnknownTile({layer, false, 0}, rect)});
    ASSERT_TRUE(DecodeTile(tile, "tile", map).ok());
  }
  EXPECT_EQ((map.occupancy[Cell{99, 79}]), CellState::kUnknown);
  EXPECT_EQ((map.occupancy[Cell{63, 64}]), CellState::kFree);
  EXPECT_TRUE(std::isnan(map.gas_mean_ppm[Cell{64, 64}]));
  EXPECT_TRUE(std::isnan(map.gas_variance_ppm2[Cell{64, 64}]));
}

}  // namespace layer_tiles_test
}  // namespace plumescout::server
