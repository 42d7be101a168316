// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/gas/gas_map.h"

namespace plumescout {
namespace field_region_test {

constexpr double kResolution_m = 0.1;
constexpr double kTile_m = 6.4;
constexpr int kTile = 64;

// Free tiles, the first of which begins at (x, y) tiles from (0, 0).
Grid<CellState> OpenGround(int x, int y, int width, int height) {
  const GridGeometry geometry{x * kTile_m, y * kTile_m, kResolution_m, width * kTile,
                              height * kTile};
  return Grid<CellState>(geometry, CellState::kFree);
}

Point2 MiddleOfTile(int x, int y) { return {(x + 0.5) * kTile_m, (y + 0.5) * kTile_m}; }

std::int64_t FreeCells(const Grid<CellState>& states) {
  return std::count(states.values().begin(), states.values().end(), CellState::kFree);
}

TEST(FieldRegionTest, NothingIsInItBeforeTheFirstVisit) {
  FieldRegion region(10.0, kResolution_m);
  EXPECT_EQ(region.Within(OpenGround(0, 0, 3, 2)).size(), 0U);
  EXPECT_FALSE(region.Contains({0, 0}));
}

TEST(FieldRegionTest, WithoutAReachItIsEverywhere) {
  FieldRegion region(0.0, kResolution_m);
  const Grid<CellState> ground = OpenGround(0, 0, 3, 2);
  EXPECT_EQ(&region.Within(ground), &ground);
  EXPECT_TRUE(region.Contains({191, 127}));
  EXPECT_FALSE(region.IsNew({1.0, 1.0}));
}

TEST(FieldRegionTest, AMapWithinReachIsTakenAsItIs) {
  FieldRegion region(2.0 * kTile_m, kResolution_m);
  region.Visit(MiddleOfTile(-1, 2));
  const Grid<CellState> ground = OpenGround(-3, 1, 5, 3);
  EXPECT_EQ(&region.Within(ground), &ground);
}

// Of every tile of a larger map, before and after it has grown to all sides, by the rule itself.
TEST(FieldRegionTest, HoldsTheTilesNoFartherThanTheReachFromAVisitedOne) {
  constexpr double kReach_m = 14.0;
  const std::vector<std::pair<int, int>> visited = {{-4, 3}, {5, 5}};
  FieldRegion region(kReach_m, kResolution_m);
  for (const auto& [x, y] : visited) region.Visit(MiddleOfTile(x, y));
  const std::vector<Grid<CellState>> maps = {OpenGround(-3, 2, 6, 7), OpenGround(-9, -3, 20, 15)};
  for (const Grid<CellState>& map : maps) {
    const Grid<CellState>& part = region.Within(map);
    std::int64_t inside = 0;
    for (int y = 0; y < map.height() / kTile; ++y) {
      for (int x = 0; x < map.width() / kTile; ++x) {
        const Point2 middle = map.geometry().Center({x * kTile + kTile / 2, y * kTile + kTile / 2});
        bool near = false;
        for (const auto& [tile_x, tile_y] : visited) {
          const Point2 there = MiddleOfTile(tile_x, tile_y);
          const double gap_x_m = std::max(0.0, std::abs(middle.x_m - there.x_m) - kTile_m - 0.1);
          const double gap_y_m = std::max(0.0, std::abs(middle.y_m - there.y_m) - kTile_m - 0.1);
          near = near || std::hypot(gap_x_m, gap_y_m) <= kReach_m;
        }
        EXPECT_EQ(region.Contains({x * kTile, y * kTile}), near);
        EXPECT_EQ(region.Contains({x * kTile + kTile - 1, y * kTile + kTile - 1}), near);
        EXPECT_EQ(part.At(part.geometry().CellAt(middle), CellState::kUnknown) == CellState::kFree,
                  near);
        inside += near ? 1 : 0;
      }
    }
    EXPECT_EQ(FreeCells(part), inside * kTile * kTile);
    EXPECT_LT(part.size(), map.size());
  }
}

TEST(FieldRegionTest, WhatOnePlaceBringsInIsKnownBeforehand) {
  for (const double reach_m : {0.5, 6.4, 14.0, 25.0}) {
    FieldRegion region(reach_m, kResolution_m);
    region.Visit(MiddleOfTile(0, 0));
    const Grid<CellState>& part = region.Within(OpenGround(-9, -9, 19, 19));
    EXPECT_EQ(FreeCells(part), region.TilesAround() * kTile * kTile) << reach_m;
    EXPECT_EQ(part.width(), region.WidestAround_cells()) << reach_m;
  }
}

TEST(FieldRegionTest, AVisitedMapIsInItToItsCorners) {
  FieldRegion region(0.1, kResolution_m);
  const Grid<CellState> ground = OpenGround(1, -2, 4, 3);
  region.VisitAll(ground.geometry());
  EXPECT_EQ(&region.Within(ground), &ground);
}

// The cut is an edge of the field, as unknown cells are. With the precisions of [XIT] the field
// forgets e-fold within 55 cells and the region ends at least 256 cells away; here that is 27 and
// 128, so that the whole field can be computed as well.
TEST(FieldRegionTest, AtTheRobotTheFieldIsThatOfTheWholeMap) {
  GasOptions options;
  options.background_precision_per_ppm2 = 0.004;
  const Grid<CellState> ground = OpenGround(0, 0, 9, 9);
  FieldRegion region(1.5 * kTile_m, kResolution_m);
  GasMap whole(options);
  GasMap near(options);
  for (int k = 0; k < 12; ++k) {
    const Point2 place{4.05 * kTile_m + 0.5 * k, 4.5 * kTile_m};
    whole.Add(0, place, {20.0 + k});
    near.Add(0, place, {20.0 + k});
    region.Visit(place);
  }
  ASSERT_TRUE(whole.Refresh(ground, 0).ok());
  const Grid<CellState>& part = region.Within(ground);
  ASSERT_TRUE(near.Refresh(part, 0).ok());
  EXPECT_EQ(FreeCells(part), 25 * kTile * kTile);
  double mean_ppm = 0.0;
  double variance_ratio = 0.0;
  double edge_ratio = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Point2 place = part.geometry().Center(part.geometry().CellAtIndex(i));
    const Cell cell = ground.geometry().CellAt(place);
    const double mean_error_ppm =
        static_cast<double>(std::abs(near.mean_ppm()[i] - whole.mean_ppm()[cell]));
    const double ratio =
        static_cast<double>(std::abs(near.variance_ppm2()[i] / whole.variance_ppm2()[cell] - 1.0F));
    edge_ratio = std::max(edge_ratio, ratio);
    const bool is_visited = place.x_m > 4.0 * kTile_m && place.x_m < 5.0 * kTile_m &&
                            place.y_m > 4.0 * kTile_m && place.y_m < 5.0 * kTile_m;
    if (!is_visited) continue;
    mean_ppm = std::max(mean_ppm, mean_error_ppm);
    variance_ratio = std::max(variance_ratio, ratio);
  }
  RecordProperty("mean_error_ppm", std::to_string(mean_ppm));
  RecordProperty("variance_error_ratio", std::to_string(variance_ratio));
  EXPECT_LT(mean_ppm, 0.005);
  EXPECT_LT(variance_ratio, 1e-3);
  EXPECT_GT(edge_ratio, 0.1) << "the edge itself is where it is off";
  EXPECT_LT(edge_ratio, 3.0);
}

}  // namespace field_region_test
}  // namespace plumescout
