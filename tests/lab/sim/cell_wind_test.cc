// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/cell_wind.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/types/rng.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/wind.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace cell_wind_test {

WindField RandomWind(const GridGeometry& geometry) {
  WindField wind{Grid<float>(geometry), Grid<float>(geometry)};
  Rng rng(3);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    wind.u_mps[i] = static_cast<float>(rng.Gaussian());
    wind.v_mps[i] = static_cast<float>(rng.Gaussian());
  }
  return wind;
}

Grid<CellState> Room() { return Rasterize(SmallLayout())->occupancy; }

TEST(CellWindTest, FacesHaveTheMeansOfTheirCellsAndWallsNothing) {
  const Grid<CellState> room = Room();
  const WindField cells = RandomWind(room.geometry());
  const MacField wind = FaceWind(cells, room);
  EXPECT_FLOAT_EQ(static_cast<float>(wind.u(10, 7)),
                  0.5F * (cells.u_mps[Cell(9, 7)] + cells.u_mps[Cell(10, 7)]));
  EXPECT_FLOAT_EQ(static_cast<float>(wind.v(10, 7)),
                  0.5F * (cells.v_mps[Cell(10, 6)] + cells.v_mps[Cell(10, 7)]));
  EXPECT_EQ(wind.u(2, 7), 0.0);    // the western wall is 2 cells thick
  EXPECT_EQ(wind.u(18, 15), 0.0);  // the box
}

TEST(CellWindTest, ProjectionLeavesNoDivergenceAndNoWindThroughWalls) {
  const Grid<CellState> room = Room();
  const MacField wind = *WithoutDivergence(FaceWind(RandomWind(room.geometry()), room), room);
  for (std::size_t i = 0; i < room.size(); ++i) {
    const Cell cell = room.geometry().CellAtIndex(i);
    // The pressures of winds of some 1 m/s in a room of 40 cells are below 100 m/s: a millionth.
    if (room[cell] == CellState::kFree) {
      EXPECT_NEAR(wind.NetOutflow_mps(cell), 0.0, 1e-4);
    }
  }
  EXPECT_EQ(wind.u(2, 7), 0.0);
  EXPECT_EQ(wind.u(18, 15), 0.0);
}

// An eddy that turns within the room has no divergence: nothing is to be taken away.
TEST(CellWindTest, ProjectionKeepsAWindWithoutDivergence) {
  const Grid<CellState> room = Room();
  MacField eddy(room.geometry());
  eddy.u(10, 7) = eddy.v(10, 8) = 1.0;
  eddy.u(10, 8) = eddy.v(9, 8) = -1.0;
  for (const Cell cell : {Cell(9, 7), Cell(10, 7), Cell(9, 8), Cell(10, 8)}) {
    ASSERT_EQ(eddy.NetOutflow_mps(cell), 0.0);
  }
  const MacField wind = *WithoutDivergence(eddy, room);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      EXPECT_NEAR(wind.u(x, y), eddy.u(x, y), 1e-4);
      EXPECT_NEAR(wind.v(x, y), eddy.v(x, y), 1e-4);
    }
  }
}

TEST(CellWindTest, ARoomWithoutFreeCellsHasNoWind) {
  const Grid<CellState> solid(Room().geometry(), CellState::kOccupied);
  const auto wind = WithoutDivergence(FaceWind(RandomWind(solid.geometry()), solid), solid);
  ASSERT_TRUE(wind.ok());
  EXPECT_EQ(wind->MaxMagnitudes().u_mps, 0.0);
}

}  // namespace cell_wind_test
}  // namespace plumescout::lab
