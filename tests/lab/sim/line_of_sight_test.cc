// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/line_of_sight.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "core/grid/ray.h"
#include "core/types/rng.h"
#include "tests/support/grid_art.h"

namespace plumescout::lab {
namespace line_of_sight_test {

using testing::CellInArt;
using testing::CellsInArt;
using testing::GridArt;
using testing::GridFromArt;

bool Sees(LineOfSight& sight, Cell viewer, Cell cell) {
  const int radius = sight.radius_cells();
  const std::uint64_t row =
      sight.From(viewer)[static_cast<std::size_t>(cell.y - viewer.y + radius)];
  return (row >> (cell.x - viewer.x + radius) & 1) != 0;
}

TEST(LineOfSightTest, SeesEverythingInTheOpenUpToItsRadius) {
  const Grid<CellState> open = GridFromArt(GridArt(9, "........."));
  LineOfSight sight(open, 3);
  for (int y = 1; y <= 7; ++y) {
    for (int x = 1; x <= 7; ++x) EXPECT_TRUE(Sees(sight, {4, 4}, {x, y})) << x << ", " << y;
  }
}

TEST(LineOfSightTest, EndsAtTheEdgeOfTheRaster) {
  const Grid<CellState> open = GridFromArt({"..", ".."});
  LineOfSight sight(open, 2);
  EXPECT_TRUE(Sees(sight, {0, 0}, {1, 1}));
  EXPECT_FALSE(Sees(sight, {0, 0}, {-1, 0}));
  EXPECT_FALSE(Sees(sight, {0, 0}, {2, 1}));
}

TEST(LineOfSightTest, DoesNotSeeThroughWallsNorWallsThemselves) {
  const GridArt art = {
      "vv.hh",  //
      "vv#hh",  //
      "vv#hh",  //
      "Xv#hh",
  };
  const Grid<CellState> grid = GridFromArt(art);
  LineOfSight sight(grid, 4);
  const Cell viewer = CellInArt(art, 'X');
  for (const Cell cell : CellsInArt(art, 'v')) EXPECT_TRUE(Sees(sight, viewer, cell));
  for (const Cell cell : CellsInArt(art, 'h')) EXPECT_FALSE(Sees(sight, viewer, cell));
  for (const Cell cell : CellsInArt(art, '#')) EXPECT_FALSE(Sees(sight, viewer, cell));
}

TEST(LineOfSightTest, LooksThroughADoor) {
  const GridArt art = {
      ".#...",  //
      ".#...",  //
      "X.vvv",  //
      ".#...",
  };
  const Grid<CellState> grid = GridFromArt(art);
  LineOfSight sight(grid, 4);
  for (const Cell cell : CellsInArt(art, 'v')) {
    EXPECT_TRUE(Sees(sight, CellInArt(art, 'X'), cell));
  }
}

TEST(LineOfSightTest, IsThatOfWalkingEveryLine) {
  Rng rng(5);
  GridGeometry geometry;
  geometry.width = geometry.height = 25;
  int seen = 0;
  for (int map = 0; map < 20; ++map) {
    Grid<CellState> grid(geometry, CellState::kFree);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (rng.Uniform01() < 0.01 * map) grid[i] = CellState::kOccupied;
    }
    const Cell viewer{12, 12};
    grid[viewer] = CellState::kFree;
    LineOfSight sight(grid, 10);
    for (int y = 2; y <= 22; ++y) {
      for (int x = 2; x <= 22; ++x) {
        const auto free = [&](Cell cell, double length_cells) {
          return grid[cell] == CellState::kFree || length_cells < 1e-9;  // corners do not count
        };
        const bool walked =
            WalkSegment(geometry, geometry.Center(viewer), geometry.Center({x, y}), free);
        ASSERT_EQ(Sees(sight, viewer, {x, y}), walked) << map << ": " << x << ", " << y;
        seen += walked ? 1 : 0;
      }
    }
  }
  EXPECT_GT(seen, 0);
}

}  // namespace line_of_sight_test
}  // namespace plumescout::lab
