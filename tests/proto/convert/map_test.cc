// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

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
  map.frontiers = {{FrontierKind::kGas, {{1, 2}, {2, 3}}, {0.1, 0.2}, {2, 2}, 3.5, true, false},
                   {FrontierKind::kOccupancy, {{9, 9}}, {1.0, 2.0}, {}, 0.0, false, true}};
  map.robots = {{"r1", 0.25, true, {1.0, 2.0, 0.5}, 40, 2}, {"r2", 0.2, false, {}, 0, 0, true}};
  map.gas_counters = {10, 7, 2, 3};
  map.gas_quality = {1e-4, 1e-5, 1'700'000'000'000'000'000, 0.02, 900, 8, 2, 1, 2e-4, 3e-5};
  map.gas_audits = {5, 2e-5, 4e-6, 1};
  map.phase = MissionPhase::kGasProbing;
  return map;
}

bool SameBits(const Grid<float>& a, const Grid<float>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] != b[i] && !(std::isnan(a[i]) && std::isnan(b[i]))) return false;
  }
  return a.geometry() == b.geometry();
}

TEST(MapTest, MapSurvivesTheRoundTripInFullPrecision) {
  const MapSnapshot map = TestMap();
  const auto back = FromProto(ToProto(map, "hall", {.full_precision = true}));
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->revision, map.revision);
  EXPECT_EQ(back->occupancy, map.occupancy);
  EXPECT_TRUE(SameBits(back->gas_mean_ppm, map.gas_mean_ppm));
  EXPECT_TRUE(SameBits(back->gas_variance_ppm2, map.gas_variance_ppm2));
  EXPECT_EQ(back->gas_threshold_ppm, map.gas_threshold_ppm);
  EXPECT_EQ(back->robots, map.robots);
  EXPECT_EQ(back->gas_counters, map.gas_counters);
  EXPECT_EQ(back->gas_quality, map.gas_quality);
  EXPECT_EQ(back->gas_audits, map.gas_audits);
  EXPECT_EQ(back->phase, map.phase);
}

TEST(MapTest, FrontiersSurviveTheRoundTrip) {
  const MapSnapshot map = TestMap();
  const MapSnapshot back = FromProto(ToProto(map, "hall", {})).value();
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
  const v1::GetMapResponse proto = ToProto(TestMap(), "hall", view);
  EXPECT_EQ(proto.tiles_size(), 1);
  const MapSnapshot back = FromProto(proto).value();
  EXPECT_EQ(back.occupancy, TestMap().occupancy);
  EXPECT_TRUE(std::isnan(back.gas_mean_ppm[Cell{3, 5}]));
}

TEST(MapTest, MapBeforeTheFirstScanHasNoCells) {
  MapSnapshot map;
  const auto back = FromProto(ToProto(map, "hall", {}));
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_EQ(back->occupancy.size(), 0u);
}

TEST(MapTest, ViewNamesLayersOrAll) {
  google::protobuf::RepeatedField<int> layers;
  EXPECT_EQ(MapViewFromProto(layers, true, "layers").value(), (MapView{true, true, true, true}));
  layers.Add(v1::MAP_LAYER_GAS_MEAN);
  EXPECT_EQ(MapViewFromProto(layers, false, "layers").value(),
            (MapView{false, true, false, false}));
  layers.Add(99);
  EXPECT_EQ(FieldViolations(MapViewFromProto(layers, false, "layers").status()).at(0).field,
            "layers[1]");
  layers.Set(1, v1::MAP_LAYER_UNSPECIFIED);
  EXPECT_FALSE(MapViewFromProto(layers, false, "layers").ok());
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
    v1::GetMapResponse proto = ToProto(TestMap(), "hall", {});
    bad.spoil(proto);
    const auto violations = FieldViolations(FromProto(proto).status());
    ASSERT_EQ(violations.size(), 1u) << bad.field;
    EXPECT_EQ(violations[0].field, bad.field);
  }
}

}  // namespace map_test
}  // namespace plumescout
