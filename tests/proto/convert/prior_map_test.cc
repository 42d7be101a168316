// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/prior_map.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>
#include <string>

#include "core/types/rng.h"
#include "proto/convert/options.h"
#include "proto/convert/status.h"

namespace plumescout {
namespace prior_map_test {

Grid<CellState> RandomMap(int width, int height) {
  Rng rng(3);
  Grid<CellState> map({-1.5, 0.5, 0.1, width, height});
  for (CellState& state : map.values()) state = static_cast<CellState>(rng.Below(3));
  return map;
}

std::string Deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string deflated(size, '\0');
  compress(reinterpret_cast<Bytef*>(deflated.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  deflated.resize(size);
  return deflated;
}

v1::KnownCells TwoByTwo(const std::string& cells) {
  v1::KnownCells proto;
  proto.mutable_geometry()->mutable_origin();
  proto.mutable_geometry()->set_resolution_m(0.1);
  proto.mutable_geometry()->set_column_count(2);
  proto.mutable_geometry()->set_row_count(2);
  proto.set_deflated_data(Deflated(cells));
  return proto;
}

std::string BlamedBy(const absl::Status& status) {
  const auto violations = FieldViolations(status);
  return violations.empty() ? "" : violations[0].field;
}

TEST(PriorMapConvertTest, MapsSurviveTheRoundTrip) {
  const Grid<CellState> map = RandomMap(37, 21);
  const auto back = FromProto(ToProto(map).cells(), "cells");
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(*back, map);
}

TEST(PriorMapConvertTest, BytesAreOneACellFromTheSouthWest) {
  const auto map = FromProto(TwoByTwo({0, 1, 2, 1}), "cells");
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_EQ((*map)[(Cell{0, 0})], CellState::kUnknown);
  EXPECT_EQ((*map)[(Cell{1, 0})], CellState::kFree);
  EXPECT_EQ((*map)[(Cell{0, 1})], CellState::kOccupied);
}

TEST(PriorMapConvertTest, AMapOfMillionsOfCellsFitsARequest) {
  Grid<CellState> rooms({0.0, 0.0, 0.1, 2000, 2000}, CellState::kFree);
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const Cell cell = rooms.geometry().CellAtIndex(i);
    if (cell.x % 50 == 0 || cell.y % 50 == 0) rooms[i] = CellState::kOccupied;
  }
  EXPECT_LT(ToProto(rooms).ByteSizeLong(), 256U << 10);  // what servers take by default
}

TEST(PriorMapConvertTest, OtherThanAByteACellIsRefused) {
  for (const std::string& cells : {std::string(), std::string(3, 1), std::string(5, 1)}) {
    EXPECT_EQ(BlamedBy(FromProto(TwoByTwo(cells), "map.cells").status()),
              "map.cells.deflated_data");
  }
  v1::KnownCells plain = TwoByTwo("");
  plain.set_deflated_data(std::string(4, 1));
  EXPECT_EQ(BlamedBy(FromProto(plain, "map.cells").status()), "map.cells.deflated_data");
}

TEST(PriorMapConvertTest, AnUnknownCodeIsRefusedWithItsValue) {
  const absl::Status status = FromProto(TwoByTwo({1, 1, 7, 1}), "map.cells").status();
  EXPECT_EQ(BlamedBy(status), "map.cells.deflated_data");
  EXPECT_NE(status.message().find("= 7 "), absl::string_view::npos) << status;
}

TEST(PriorMapConvertTest, AGeometryThatIsNoneIsRefused) {
  v1::KnownCells proto = TwoByTwo({1, 1, 1, 1});
  proto.mutable_geometry()->set_resolution_m(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(BlamedBy(FromProto(proto, "map.cells").status()), "map.cells.geometry.resolution_m");
  proto = TwoByTwo({1, 1, 1, 1});
  proto.mutable_geometry()->set_column_count(-2);
  EXPECT_EQ(BlamedBy(FromProto(proto, "map.cells").status()), "map.cells.geometry.column_count");
  proto.mutable_geometry()->set_column_count(2'000'000'000);
  EXPECT_FALSE(FromProto(proto, "map.cells").ok());
}

TEST(PriorMapConvertTest, OptionsCarryTheMapBothWays) {
  MissionOptions options;
  options.prior_map = std::make_shared<const Grid<CellState>>(RandomMap(40, 30));
  for (const v1::MissionOptions& proto : {ToProto(options), ChangesToProto(options)}) {
    const auto back = FromProto(proto, MissionOptions{}, "options");
    ASSERT_TRUE(back.ok()) << back.status();
    ASSERT_NE(back->prior_map, nullptr);
    EXPECT_EQ(*back->prior_map, *options.prior_map);
  }
  EXPECT_FALSE(ToProto(MissionOptions{}).has_prior_map());
}

TEST(PriorMapConvertTest, AMapThatDoesNotSuitTheMissionIsRefused) {
  v1::MissionOptions proto;
  *proto.mutable_prior_map()->mutable_cells() = TwoByTwo({1, 1, 1, 1});
  EXPECT_TRUE(FromProto(proto, MissionOptions{}, "options").ok());
  proto.mutable_occupancy()->set_resolution_m(0.2);
  const absl::Status status = FromProto(proto, MissionOptions{}, "options").status();
  EXPECT_EQ(BlamedBy(status), "options.prior_map");
  EXPECT_NE(status.message().find("resolution_m = 0.1 "), absl::string_view::npos) << status;
}

TEST(PriorMapConvertTest, NoMapOrUnreadFilesAreRefused) {
  v1::MissionOptions proto;
  proto.mutable_prior_map();
  EXPECT_EQ(BlamedBy(FromProto(proto, MissionOptions{}, "options").status()), "options.prior_map");
  proto.mutable_prior_map()->mutable_files()->set_yaml("image: a.pgm");
  EXPECT_EQ(BlamedBy(FromProto(proto, MissionOptions{}, "options").status()), "options.prior_map");
}

TEST(PriorMapConvertTest, OfFilesTheMapComesWithTheDefaults) {
  v1::MissionOptions proto;
  proto.mutable_prior_map()->mutable_files();
  MissionOptions defaults;
  defaults.prior_map = std::make_shared<const Grid<CellState>>(RandomMap(40, 30));
  const auto options = FromProto(proto, defaults, "options");
  ASSERT_TRUE(options.ok()) << options.status();
  EXPECT_EQ(options->prior_map, defaults.prior_map);
}

}  // namespace prior_map_test
}  // namespace plumescout
