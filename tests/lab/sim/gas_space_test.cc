// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/gas_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "core/types/rng.h"
#include "tests/lab/sim/small_layout.h"

namespace plumescout::lab {
namespace gas_space_test {

TEST(GasSpaceTest, TellsRoomOpeningsAndSolidsApart) {
  const Grid<GasSpace> spaces = GasSpaces(*Rasterize(SmallLayout()));
  EXPECT_EQ(spaces[Cell(10, 15)], GasSpace::kInside);
  EXPECT_EQ(spaces[Cell(0, 15)], GasSpace::kOutside);   // inlet
  EXPECT_EQ(spaces[Cell(39, 15)], GasSpace::kOutside);  // outlet
  EXPECT_EQ(spaces[Cell(0, 5)], GasSpace::kSolid);      // wall
  EXPECT_EQ(spaces[Cell(20, 15)], GasSpace::kSolid);    // box
}

TEST(GasSpaceTest, ClearanceIsTheStepsToTheNearestSolid) {
  Rng rng(5);
  GridGeometry geometry;
  geometry.width = 30;
  geometry.height = 20;
  for (int map = 0; map < 20; ++map) {
    Grid<GasSpace> spaces(geometry, GasSpace::kInside);
    for (std::size_t i = 0; i < spaces.size(); ++i) {
      if (rng.Uniform01() < 0.002 * map) spaces[i] = GasSpace::kSolid;
    }
    const Grid<std::uint8_t> clearances = Clearances(spaces);
    for (std::size_t i = 0; i < spaces.size(); ++i) {
      const Cell cell = geometry.CellAtIndex(i);
      int nearest = 255;
      for (std::size_t k = 0; k < spaces.size(); ++k) {
        if (spaces[k] != GasSpace::kSolid) continue;
        const Cell solid = geometry.CellAtIndex(k);
        nearest =
            std::min(nearest, std::max(std::abs(solid.x - cell.x), std::abs(solid.y - cell.y)));
      }
      ASSERT_EQ(clearances[i], nearest) << map << ": " << cell.x << ", " << cell.y;
    }
  }
}

}  // namespace gas_space_test
}  // namespace plumescout::lab
