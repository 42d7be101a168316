// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/layout_raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/grid/distance_field.h"
#include "core/grid/flood.h"
#include "lab/sim/layout_yaml.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace layout_raster_test {

using ::testing::HasSubstr;

Layout EmptyRoom() {
  Layout layout = SmallLayout();
  layout.boxes.clear();
  layout.openings.clear();
  return layout;
}

std::int64_t CountFree(const LayoutRaster& raster) {
  const auto& states = raster.occupancy.values();
  return std::count(states.begin(), states.end(), CellState::kFree);
}

void ExpectInvalid(const Layout& layout, const std::string& message) {
  const absl::Status status = Rasterize(layout).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), HasSubstr(message));
}

TEST(LayoutRasterTest, SurroundsTheRoomWithItsBorder) {
  const auto raster = Rasterize(EmptyRoom());
  ASSERT_TRUE(raster.ok()) << raster.status();
  EXPECT_EQ(raster->occupancy.width(), 40);
  EXPECT_EQ(raster->occupancy.height(), 30);
  EXPECT_EQ(CountFree(*raster), 36 * 26);  // less 2 cells on each side
  EXPECT_EQ(raster->occupancy[Cell(1, 15)], CellState::kOccupied);
  EXPECT_EQ(raster->occupancy[Cell(2, 15)], CellState::kFree);
}

TEST(LayoutRasterTest, CutsDoorsIntoWalls) {
  Layout layout = EmptyRoom();
  layout.walls = {{{2.0, 0.0}, {2.0, 3.0}, 0.2, {{1.5, 1.0}}}};
  const auto raster = Rasterize(layout);
  ASSERT_TRUE(raster.ok()) << raster.status();
  for (int y = 2; y < 28; ++y) {
    const bool door = y >= 10 && y < 20;
    for (const int x : {19, 20}) {
      EXPECT_EQ(raster->occupancy[Cell(x, y)] == CellState::kFree, door) << x << ", " << y;
    }
    EXPECT_EQ(raster->occupancy[Cell(18, y)], CellState::kFree);
    EXPECT_EQ(raster->occupancy[Cell(21, y)], CellState::kFree);
  }
}

TEST(LayoutRasterTest, JoinsWallsAtCorners) {
  Layout layout = EmptyRoom();
  layout.walls = {{{2.0, 1.0}, {2.0, 2.0}, 0.2, {}}, {{2.0, 2.0}, {3.0, 2.0}, 0.2, {}}};
  const auto raster = Rasterize(layout);
  ASSERT_TRUE(raster.ok()) << raster.status();
  EXPECT_EQ(raster->occupancy[Cell(19, 20)], CellState::kOccupied);  // the outer corner
}

TEST(LayoutRasterTest, DrawsObliqueWalls) {
  Layout layout = EmptyRoom();
  layout.walls = {{{1.0, 0.5}, {3.0, 2.5}, 0.3, {}}};
  const auto raster = Rasterize(layout);
  ASSERT_TRUE(raster.ok()) << raster.status();
  EXPECT_EQ(raster->occupancy[Cell(20, 15)], CellState::kOccupied);
  EXPECT_EQ(raster->occupancy[Cell(20, 18)], CellState::kFree);  // 0.21 m off the wall's axis
}

TEST(LayoutRasterTest, KeepsOpeningsClosedInTheMapButOpenToAir) {
  const auto raster = Rasterize(SmallLayout());
  ASSERT_TRUE(raster.ok()) << raster.status();
  for (const int x : {0, 1, 38, 39}) {
    EXPECT_EQ(raster->occupancy[Cell(x, 15)], CellState::kOccupied);
    EXPECT_EQ(raster->flow.fluid[Cell(x, 15)], 1);
    EXPECT_EQ(raster->flow.fluid[Cell(x, 9)], 0);
  }
  ASSERT_EQ(raster->flow.openings.size(), 20u);
  const BoundaryFace& inlet = raster->flow.openings.front();
  EXPECT_EQ(inlet.cell, (Cell{0, 10}));
  EXPECT_EQ(inlet.side, Side::kWest);
  EXPECT_EQ(inlet.inflow_mps, 1.0);
  const BoundaryFace& outlet = raster->flow.openings.back();
  EXPECT_EQ(outlet.cell, (Cell{39, 19}));
  EXPECT_EQ(outlet.side, Side::kEast);
  EXPECT_FALSE(outlet.inflow_mps.has_value());
}

TEST(LayoutRasterTest, FillsSpaceThatNoWayLeadsTo) {
  Layout layout = EmptyRoom();
  layout.walls = {{{2.0, 0.0}, {2.0, 3.0}, 0.2, {}}};
  layout.sources[0].x_m = 3.5;
  const auto raster = Rasterize(layout);
  ASSERT_TRUE(raster.ok()) << raster.status();
  EXPECT_EQ(raster->occupancy[Cell(10, 15)], CellState::kOccupied);
  EXPECT_EQ(CountFree(*raster), 17 * 26);
}

TEST(LayoutRasterTest, WantsTheStartAndTheSourcesInOneOpenSpace) {
  Layout layout = SmallLayout();
  layout.start_pose = {2.0, 1.5, 0.0};  // in the box
  ExpectInvalid(layout, "start_pose (2, 1.5) lies in a wall or box");
  layout = SmallLayout();
  layout.sources[0].x_m = 1.9;
  ExpectInvalid(layout, "sources[0] (1.9, 1.55) lies in a wall or box");
  layout = EmptyRoom();
  layout.walls = {{{2.0, 0.0}, {2.0, 3.0}, 0.2, {}}};  // between start and source
  ExpectInvalid(layout, "sources[0] (1.05, 1.55) is cut off from the start");
}

TEST(LayoutRasterTest, RejectsOpeningsThatLeadIntoAWall) {
  Layout layout = SmallLayout();
  layout.boxes = {{{3.5, 0.8}, {3.9, 2.2}}};
  ExpectInvalid(layout, "openings[1] leads into a wall");
}

TEST(LayoutRasterTest, RejectsOpeningsThatOverlap) {
  Layout layout = SmallLayout();
  layout.openings.push_back({Side::kWest, 1.9, 2.4, std::nullopt});
  ExpectInvalid(layout, "openings[2] overlaps another opening");
}

TEST(LayoutRasterTest, RejectsInletsWithoutAnOutlet) {
  Layout layout = SmallLayout();
  layout.openings.pop_back();
  ExpectInvalid(layout, "must include an outlet");
}

TEST(LayoutRasterTest, RejectsOpeningsWithoutAnInlet) {
  Layout layout = SmallLayout();
  layout.openings[0].inflow_mps.reset();
  ExpectInvalid(layout, "must include an inlet");
  layout.openings.clear();  // a sealed room
  EXPECT_TRUE(Rasterize(layout).ok());
}

TEST(LayoutRasterTest, PutsFansIntoTheFlowButNotIntoTheMap) {
  Layout layout = EmptyRoom();
  layout.fans = {{{2.0, 1.5}, 0.0, 0.6, 2.0}};
  const auto raster = Rasterize(layout);
  ASSERT_TRUE(raster.ok()) << raster.status();
  EXPECT_EQ(raster->flow.fans.size(), 6u);
  EXPECT_EQ(raster->occupancy, Rasterize(EmptyRoom())->occupancy);
}

TEST(LayoutRasterTest, RejectsFansInAWall) {
  Layout layout = SmallLayout();
  layout.fans = {{{1.5, 1.0}, 0.0, 0.4, 2.0}, {{2.0, 1.5}, 0.0, 0.4, 2.0}};  // the box
  ExpectInvalid(layout, "fans[1] reaches into a wall");
}

// All places of the bundled scene can be visited by a robot that keeps 0.2 m off the walls, to
// within the inflated margin itself.
TEST(LayoutRasterTest, LeavesARobotWayThroughTheBundledScene) {
  const auto layout = ReadLayout("lab/scenes/industrial_16x20.yaml");
  ASSERT_TRUE(layout.ok()) << layout.status();
  const auto raster = Rasterize(*layout);
  ASSERT_TRUE(raster.ok()) << raster.status();
  const GridGeometry& geometry = raster->occupancy.geometry();
  Grid<std::uint8_t> occupied(geometry);
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    occupied[i] = raster->occupancy[i] == CellState::kOccupied ? 1 : 0;
  }
  constexpr int kInflation_cells2 = 2 * 2;  // 0.2 m
  const Grid<std::int32_t> distance = SquaredDistances_cells2(occupied);
  Grid<std::uint8_t> traversable(geometry);
  for (std::size_t i = 0; i < distance.size(); ++i) {
    traversable[i] = distance[i] > kInflation_cells2 ? 1 : 0;
  }
  const Cell start = geometry.CellAt(layout->start_pose.position());
  EXPECT_EQ(ReachableCells(traversable, {start}), traversable);
  for (const GasSource& source : layout->sources) {
    EXPECT_EQ(traversable[geometry.CellAt({source.x_m, source.y_m})], 1) << source.id;
  }
}

}  // namespace layout_raster_test
}  // namespace plumescout::lab
