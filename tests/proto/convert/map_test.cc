// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "proto/convert/geometry.h"
#include "proto/convert/status.h"

namespace plumescout {
namespace map_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

MapSnapshot TestMap() {
  const GridGeometry geometry{-6.4, 0.0, 0.1, 64, 128};
  MapSnapshot map;
  map.revision = 17;
  map.occupancy = Grid<CellState>(geometry, CellState::kUnknown);
  map.gas_mean_ppm = Grid<float>(geometry, kNan);
  map.gas_variance_ppm2 = map.gas_mean_ppm;
  for (int x = 0; x < 20; ++x) {
    map.occupancy[Cell{x, 5}] = CellState::kFree;
    map.gas_mean_ppm[Cell{x, 5}] = static_cast<float>(x) * 0.5f;
    map.gas_variance_ppm2[Cell{x, 5}] = 0.25f;
  }
  map.gas_threshold_ppm = 2.5;
  map.objective = ObjectiveStatus{.state = ObjectiveState::kMet, .confidence = 0.97};
  map.objective_explanation = "Clean.";
  map.frontiers = {{FrontierKind::kGas, {{1, 2}, {2, 3}}, {0.1, 0.2}, {2, 2}, 3.5, true, false},
                   {FrontierKind::kOccupancy, {{9, 9}}, {1.0, 2.0}, {}, 0.0, false, true}};
  map.robots = {{"r1", 0.25, true, {1.0, 2.0, 0.5}, 40, 2}, {"r2", 0.2, false, {}, 0, 0, true}};
  map.robots[1].frame_suspect = true;
  map.gas_counters = {10, 7, 2, 3};
  map.gas_quality = {1e-4, 1e-5, 1'700'000'000'000'000'000, 0.02, 900, 8, 2, 1, 2e-4, 3e-5, 7.5};
  map.gas_audits = {5, 2e-5, 4e-6, 1};
  map.gases = {{"methane", map.gas_counters, map.gas_quality, map.gas_audits},
               {"ozone", {3, 1, 0, 2}, {}, {2, 1e-5, 0.0, 0}}};
  map.sensor_offsets = {{"r1", "pid", 0.5, 0.1, 30, true, false, "ozone"}};
  map.keep_out = {{{{1, 2}, {3, 4}, {5, 7}}, "spill"}};
  map.phase = MissionPhase::kGasProbing;
  return map;
}

// All of a map in one part, a tile a layer.
v1::GetMapResponse Whole(const MapSnapshot& map, const MapView& view = {}) {
  v1::GetMapResponse proto;
  proto.set_revision(map.revision);
  *proto.mutable_status() = ToProto(map, map.occupancy.geometry(), "hall");
  const CellRect all = WholeRaster(map.occupancy.geometry());
  const auto encode = view.full_precision ? EncodeFloats : EncodeScaled;
  if (view.occupancy) *proto.add_tiles() = EncodeStates(map.occupancy, all);
  if (view.gas_mean) {
    *proto.add_tiles() = encode(v1::MAP_LAYER_GAS_MEAN, map.gas_mean_ppm, all);
  }
  if (view.gas_variance) {
    *proto.add_tiles() = encode(v1::MAP_LAYER_GAS_VARIANCE, map.gas_variance_ppm2, all);
  }
  return proto;
}

bool SameBits(const Grid<float>& a, const Grid<float>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i] && !(std::isnan(a[i]) && std::isnan(b[i]))) return false;
  }
  return a.geometry() == b.geometry();
}

TEST(MapTest, MapSurvivesTheRoundTripInFullPrecision) {
  const MapSnapshot map = TestMap();
  const auto back = FromProto(Whole(map, {.full_precision = true}));
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->revision, map.revision);
  EXPECT_EQ(back->occupancy, map.occupancy);
  EXPECT_TRUE(SameBits(back->gas_mean_ppm, map.gas_mean_ppm));
  EXPECT_TRUE(SameBits(back->gas_variance_ppm2, map.gas_variance_ppm2));
  EXPECT_EQ(back->gas_threshold_ppm, map.gas_threshold_ppm);
  EXPECT_EQ(back->objective, map.objective);
  EXPECT_EQ(back->objective_explanation, "Clean.");
  EXPECT_EQ(back->robots, map.robots);
  EXPECT_EQ(back->gas_counters, map.gas_counters);
  EXPECT_EQ(back->gas_quality, map.gas_quality);
  EXPECT_EQ(back->gas_audits, map.gas_audits);
  EXPECT_EQ(back->gases, map.gases);
  EXPECT_EQ(back->sensor_offsets, map.sensor_offsets);
  EXPECT_EQ(back->keep_out, map.keep_out);
  EXPECT_EQ(back->phase, map.phase);
}

TEST(MapTest, TilesOfFurtherGasesAreToldApart) {
  const MapSnapshot map = TestMap();
  const CellRect all = WholeRaster(map.occupancy.geometry());
  v1::GetMapResponse proto = Whole(map, {.full_precision = true});
  const auto add = [&](const char* species, v1::MapLayer layer, const Grid<float>& values) {
    *proto.add_tiles() = EncodeFloats(layer, values, all);
    proto.mutable_tiles(proto.tiles_size() - 1)->set_species(species);
  };
  add("ozone", v1::MAP_LAYER_GAS_MEAN, map.gas_variance_ppm2);
  add("ozone", v1::MAP_LAYER_GAS_VARIANCE, map.gas_mean_ppm);
  const auto back = FromProto(proto);
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_TRUE(SameBits(back->gas_mean_ppm, map.gas_mean_ppm));
  ASSERT_EQ(back->further_gases.size(), 1u);
  EXPECT_EQ(back->further_gases[0].species, "ozone");
  EXPECT_TRUE(SameBits(back->further_gases[0].mean_ppm, map.gas_variance_ppm2));
  EXPECT_TRUE(SameBits(back->further_gases[0].variance_ppm2, map.gas_mean_ppm));
  add("ammonia", v1::MAP_LAYER_OCCUPANCY, map.gas_mean_ppm);
  EXPECT_FALSE(FromProto(proto).ok()) << "walls are of no gas";
  proto.mutable_tiles(proto.tiles_size() - 1)->set_layer(v1::MAP_LAYER_GAS_MEAN);
  add("argon", v1::MAP_LAYER_GAS_MEAN, map.gas_mean_ppm);
  EXPECT_EQ(FromProto(proto)->further_gases.size(), 3u);
  add("xenon", v1::MAP_LAYER_GAS_MEAN, map.gas_mean_ppm);
  EXPECT_FALSE(FromProto(proto).ok()) << "no mission has five";
}

TEST(MapTest, FrontiersSurviveTheRoundTrip) {
  const MapSnapshot map = TestMap();
  const MapSnapshot back = FromProto(Whole(map)).value();
  ASSERT_EQ(back.frontiers.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.frontiers[i].kind, map.frontiers[i].kind);
    EXPECT_EQ(back.frontiers[i].cells, map.frontiers[i].cells);
    EXPECT_EQ(back.frontiers[i].centroid, map.frontiers[i].centroid);
    EXPECT_EQ(back.frontiers[i].goal_cell, map.frontiers[i].goal_cell);
    EXPECT_EQ(back.frontiers[i].travel_m, map.frontiers[i].travel_m);
    EXPECT_EQ(back.frontiers[i].reachable, map.frontiers[i].reachable);
    EXPECT_EQ(back.frontiers[i].too_small, map.frontiers[i].too_small);
  }
}

TEST(MapTest, LayersThatWereNotAskedForAreUnknown) {
  const MapView view{.occupancy = true, .gas_mean = false, .gas_variance = false};
  const v1::GetMapResponse proto = Whole(TestMap(), view);
  EXPECT_EQ(proto.tiles_size(), 1);
  const MapSnapshot back = FromProto(proto).value();
  EXPECT_EQ(back.occupancy, TestMap().occupancy);
  EXPECT_TRUE(std::isnan(back.gas_mean_ppm[Cell{3, 5}]));
}

TEST(MapTest, MapBeforeTheFirstScanHasNoCells) {
  MapSnapshot map;
  const auto back = FromProto(Whole(map));
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->occupancy.size(), 0u);
}

TEST(MapTest, TilesLieOnTheirOwnRaster) {
  v1::GetMapResponse proto;
  *proto.mutable_status() = ToProto(TestMap(), TestMap().occupancy.geometry(), "hall");
  const GridGeometry squares{-6.4, 0.0, 0.4, 16, 32};
  *proto.mutable_tile_geometry() = ToProto(squares);
  const Grid<CellState> states(squares, CellState::kOccupied);
  *proto.add_tiles() = EncodeStates(states, WholeRaster(squares));
  const MapSnapshot back = FromProto(proto).value();
  EXPECT_EQ(back.occupancy, states);
  EXPECT_EQ(back.gas_mean_ppm.geometry(), squares);
}

TEST(MapTest, LaterPartsAddTheirTiles) {
  v1::GetMapResponse first = Whole(TestMap(), {.full_precision = true});
  v1::GetMapResponse later;
  *later.add_tiles() = first.tiles(2);
  first.mutable_tiles()->RemoveLast();
  MapSnapshot map = FromProto(first).value();
  ASSERT_TRUE(AddTiles(later, map).ok());
  EXPECT_TRUE(SameBits(map.gas_variance_ppm2, TestMap().gas_variance_ppm2));
  later.mutable_tiles(0)->set_column_count(1000);
  EXPECT_EQ(FieldViolations(AddTiles(later, map)).at(0).field, "tiles[0].column_count");
}

TEST(MapTest, ViewNamesLayersOrAll) {
  v1::GetMapRequest request;
  request.set_full_precision(true);
  EXPECT_EQ(MapViewFromProto(request).value(), (MapView{true, true, true, true}));
  request.add_layers(v1::MAP_LAYER_GAS_MEAN);
  request.set_full_precision(false);
  EXPECT_EQ(MapViewFromProto(request).value(), (MapView{false, true, false, false}));
  request.add_layers(static_cast<v1::MapLayer>(99));
  EXPECT_EQ(FieldViolations(MapViewFromProto(request).status()).at(0).field, "layers[1]");
  request.set_layers(1, v1::MAP_LAYER_UNSPECIFIED);
  EXPECT_FALSE(MapViewFromProto(request).ok());
}

TEST(MapTest, ViewHasItsRegionAndLevel) {
  v1::WatchMapRequest request;
  request.set_level_of_detail(6);
  *request.mutable_region()->mutable_min() = ToProto(Point2{-1.0, 2.0});
  *request.mutable_region()->mutable_max() = ToProto(Point2{-1.0, 3.0});
  const MapView view = MapViewFromProto(request).value();
  EXPECT_EQ(view.level_of_detail, 6);
  EXPECT_EQ(view.region, (Rectangle{{-1.0, 2.0}, {-1.0, 3.0}}));
  const auto blamed = [&] { return FieldViolations(MapViewFromProto(request).status()); };
  request.mutable_region()->mutable_max()->set_y_m(1.9);
  ASSERT_EQ(blamed().size(), 1u);
  EXPECT_EQ(blamed()[0].field, "region.max.y_m");
  request.mutable_region()->clear_min();
  EXPECT_EQ(blamed().at(0).field, "region.min");
  request.clear_region();
  request.set_level_of_detail(7);
  EXPECT_EQ(blamed().at(0).field, "level_of_detail");
}

struct BadField {
  const char* field;
  std::function<void(v1::GetMapResponse&)> spoil;
};

TEST(MapTest, WhatAReaderAllocatesByIsChecked) {
  const BadField kBad[] = {
      {"status.geometry.resolution_m",
       [](auto& m) { m.mutable_status()->mutable_geometry()->set_resolution_m(-1.0); }},
      {"status.geometry.row_count",
       [](auto& m) { m.mutable_status()->mutable_geometry()->set_row_count(1'000'000'000); }},
      {"status.gas_threshold_ppm",
       [](auto& m) { m.mutable_status()->set_gas_threshold_ppm(kNan); }},
      {"status.phase", [](auto& m) { m.mutable_status()->clear_phase(); }},
      {"status.frontiers[0].kind",
       [](auto& m) {
         m.mutable_status()->mutable_frontiers(0)->set_kind(v1::GOAL_KIND_RANDOM_FREE_SPACE);
       }},
      {"status.frontiers[1].cell_rows",
       [](auto& m) { m.mutable_status()->mutable_frontiers(1)->add_cell_columns(3); }},
      {"status.frontiers[0].travel_m",
       [](auto& m) { m.mutable_status()->mutable_frontiers(0)->set_travel_m(kNan); }},
      {"status.robots[0].robot",
       [](auto& m) { m.mutable_status()->mutable_robots(0)->set_robot("r1"); }},
      {"status.robots[0].radius_m",
       [](auto& m) { m.mutable_status()->mutable_robots(0)->set_radius_m(-1.0); }},
      {"status.robots[0].pose.yaw_rad",
       [](auto& m) { m.mutable_status()->mutable_robots(0)->mutable_pose()->set_yaw_rad(kNan); }},
      {"tiles[2].layer", [](auto& m) { m.mutable_tiles(2)->clear_layer(); }},
      {"tiles[0].encoding",
       [](auto& m) { m.mutable_tiles(0)->set_encoding(v1::MapTile::ENCODING_F32); }},
      {"tiles[1].deflated_data", [](auto& m) { m.mutable_tiles(1)->clear_deflated_data(); }},
  };
  for (const BadField& bad : kBad) {
    v1::GetMapResponse proto = Whole(TestMap());
    bad.spoil(proto);
    const auto violations = FieldViolations(FromProto(proto).status());
    ASSERT_EQ(violations.size(), 1u) << bad.field;
    EXPECT_EQ(violations[0].field, bad.field);
  }
}

TEST(MapViewTest, IsAskedForAsItIsRead) {
  const MapView view{.gas_variance = false,
                     .full_precision = true,
                     .level_of_detail = 2,
                     .region = Rectangle{{-1.0, 0.0}, {3.0, 2.5}},
                     .species = {"methane"}};
  v1::GetMapRequest get;
  ToProto(view, get);
  EXPECT_EQ(*MapViewFromProto(get), view);
  v1::WatchMapRequest watch;
  ToProto(view, watch);
  EXPECT_EQ(*MapViewFromProto(watch), view);
}

}  // namespace map_test
}  // namespace plumescout
