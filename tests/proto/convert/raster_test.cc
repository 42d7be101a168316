// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "core/types/rng.h"
#include "proto/convert/status.h"

namespace plumescout {
namespace raster_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr GridGeometry kGeometry{0.0, 0.0, 0.1, 70, 50};

Grid<float> RandomValues() {
  Rng rng(3);
  Grid<float> values(kGeometry, kNan);
  for (float& value : values.values()) {
    if (rng.Uniform01() < 0.7) value = static_cast<float>(rng.Uniform(-5.0, 200.0));
  }
  return values;
}

Grid<CellState> RandomStates() {
  Rng rng(4);
  Grid<CellState> states(kGeometry);
  for (CellState& state : states.values()) state = static_cast<CellState>(rng.Below(3));
  return states;
}

bool SameBytes(const Grid<float>& a, const Grid<float>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.values().data(), b.values().data(), a.size() * sizeof(float)) == 0;
}

std::string Deflated(const std::string& raw) {
  uLongf size = compressBound(raw.size());
  std::string deflated(size, '\0');
  compress(reinterpret_cast<Bytef*>(deflated.data()), &size,
           reinterpret_cast<const Bytef*>(raw.data()), raw.size());
  deflated.resize(size);
  return deflated;
}

TEST(RasterTest, StatesSurviveTheRoundTrip) {
  const Grid<CellState> states = RandomStates();
  Grid<CellState> back(kGeometry);
  ASSERT_TRUE(DecodeStates(EncodeStates(states, WholeRaster(kGeometry)), "tile", back).ok());
  EXPECT_EQ(back, states);
}

TEST(RasterTest, FloatsSurviveToTheBit) {
  const Grid<float> values = RandomValues();
  Grid<float> back(kGeometry, 0.0f);
  const auto tile = EncodeFloats(v1::MAP_LAYER_GAS_MEAN, values, WholeRaster(kGeometry));
  ASSERT_TRUE(DecodeValues(tile, "tile", back).ok());
  EXPECT_TRUE(SameBytes(back, values));
}

TEST(RasterTest, ScaledValuesAreOffByAtMostHalfAStep) {
  const Grid<float> values = RandomValues();
  Grid<float> back(kGeometry, 0.0f);
  const auto tile = EncodeScaled(v1::MAP_LAYER_GAS_MEAN, values, WholeRaster(kGeometry));
  ASSERT_TRUE(DecodeValues(tile, "tile", back).ok());
  // Half a step of the encoding, and half a unit in the last place of a float below 256.
  const double tolerance = tile.value_scale() / 2 + 8e-6;
  EXPECT_LE(tile.value_scale(), 205.0 / 65534);
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(std::isnan(values[i]), std::isnan(back[i]));
    if (std::isnan(values[i])) continue;
    EXPECT_NEAR(back[i], values[i], tolerance);
  }
}

TEST(RasterTest, ConstantAndEmptyFieldsSurviveScaling) {
  for (const float value : {0.0f, 3.5f, kNan}) {
    const Grid<float> values(kGeometry, value);
    Grid<float> back(kGeometry, 1.0f);
    const auto tile = EncodeScaled(v1::MAP_LAYER_GAS_MEAN, values, WholeRaster(kGeometry));
    ASSERT_TRUE(DecodeValues(tile, "tile", back).ok());
    EXPECT_TRUE(SameBytes(back, values)) << value;
  }
}

TEST(RasterTest, MapWithoutCellsIsATileWithoutCells) {
  const Grid<CellState> states;
  Grid<CellState> back;
  const auto tile = EncodeStates(states, WholeRaster(states.geometry()));
  EXPECT_TRUE(DecodeStates(tile, "tile", back).ok());
}

TEST(RasterTest, TileChangesItsRectangleOnly) {
  const Grid<CellState> states(kGeometry, CellState::kOccupied);
  Grid<CellState> back(kGeometry, CellState::kUnknown);
  const auto rect = CellRect::Sized({64, 10}, 6, 5);
  ASSERT_TRUE(DecodeStates(EncodeStates(states, rect), "tile", back).ok());
  for (std::size_t i = 0; i < back.size(); ++i) {
    const Cell cell = kGeometry.CellAtIndex(i);
    const bool inside = cell.x >= 64 && cell.y >= 10 && cell.y < 15;
    ASSERT_EQ(back[i], inside ? CellState::kOccupied : CellState::kUnknown);
  }
}

class BadTileTest : public testing::Test {
 protected:
  std::string RefusedField() {
    Grid<float> values(kGeometry, 1.0f);
    const Grid<float> before = values;
    const auto violations = FieldViolations(DecodeValues(tile_, "tile", values));
    EXPECT_TRUE(SameBytes(values, before));
    return violations.empty() ? "" : violations[0].field;
  }

  v1::MapTile tile_ = EncodeScaled(v1::MAP_LAYER_GAS_MEAN, RandomValues(), {{1, 2}, {9, 10}});
};

TEST_F(BadTileTest, RectangleMustLieInTheRaster) {
  tile_.mutable_min_cell()->set_column(63);
  EXPECT_EQ(RefusedField(), "tile.column_count");
  tile_.mutable_min_cell()->set_column(-1);
  EXPECT_EQ(RefusedField(), "tile.min_cell.column");
  tile_.mutable_min_cell()->set_column(1);
  tile_.set_row_count(std::numeric_limits<int>::max());
  EXPECT_EQ(RefusedField(), "tile.row_count");
  tile_.set_row_count(-8);
  EXPECT_EQ(RefusedField(), "tile.row_count");
}

TEST_F(BadTileTest, DataMustInflateToExactlyTheCells) {
  for (const std::string& data :
       {std::string(), std::string("garbage"), Deflated(std::string(127, 'a')),
        Deflated(std::string(129, 'a')), Deflated(std::string(128, 'a')) + "more"}) {
    tile_.set_deflated_data(data);
    EXPECT_EQ(RefusedField(), "tile.deflated_data");
  }
}

TEST_F(BadTileTest, BombIsNotInflated) {
  tile_.set_deflated_data(Deflated(std::string(100'000'000, '\0')));
  EXPECT_EQ(RefusedField(), "tile.deflated_data");
}

TEST_F(BadTileTest, ScaleAndEncodingAreChecked) {
  tile_.set_value_scale(std::numeric_limits<double>::infinity());
  EXPECT_EQ(RefusedField(), "tile.value_scale");
  tile_.set_value_scale(1.0);
  tile_.set_value_offset(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(RefusedField(), "tile.value_offset");
  tile_.set_encoding(v1::MapTile::ENCODING_U8);
  EXPECT_EQ(RefusedField(), "tile.encoding");
}

TEST_F(BadTileTest, UnknownCellStateIsRefused) {
  Grid<CellState> states(kGeometry);
  v1::MapTile tile = EncodeStates(states, {{0, 0}, {2, 2}});
  tile.set_deflated_data(Deflated(std::string("\x01\x02\x03\x00", 4)));
  EXPECT_TRUE(absl::IsInvalidArgument(DecodeStates(tile, "tile", states)));
  tile.set_encoding(v1::MapTile::ENCODING_F32);
  EXPECT_TRUE(absl::IsInvalidArgument(DecodeStates(tile, "tile", states)));
}

}  // namespace raster_test
}  // namespace plumescout
