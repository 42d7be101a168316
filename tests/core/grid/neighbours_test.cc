// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/neighbours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "tests/support/grid_art.h"

namespace plumescout {
namespace neighbours_test {

TEST(Neighbours, AreTheEightCellsAroundStraightOnesFirst) {
  const std::set<Cell> offsets(kNeighbours8.begin(), kNeighbours8.end());
  EXPECT_EQ(offsets.size(), 8U);
  EXPECT_EQ(offsets.count({0, 0}), 0U);
  for (std::size_t k = 0; k < kNeighbours8.size(); ++k) {
    EXPECT_LE(std::abs(kNeighbours8[k].x), 1);
    EXPECT_LE(std::abs(kNeighbours8[k].y), 1);
    EXPECT_EQ(IsDiagonal(kNeighbours8[k]), k >= 4);
  }
}

TEST(Neighbours, PutEachDiagonalBetweenTheStraightStepsThatMakeIt) {
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(kNeighbours8[k], kNeighbours4[k]);
    EXPECT_EQ(kNeighbours8[4 + k], Shifted(kNeighbours4[k], kNeighbours4[(k + 1) % 4]));
  }
}

TEST(StepLength, IsTheDistanceOfTheCentres) {
  for (const Cell offset : kNeighbours8) {
    EXPECT_DOUBLE_EQ(StepLength_cells(offset), std::hypot(offset.x, offset.y));
  }
}

bool Allowed(const testing::GridArt& art, Cell cell, Cell offset) {
  const Grid<std::uint8_t> mask = testing::MaskFromArt(art);
  return StepAllowed(cell, offset, [&mask](Cell c) { return mask.At(c, 0) != 0; });
}

TEST(StepAllowed, LetsAStraightStepOnAnyPassableCell) {
  EXPECT_TRUE(Allowed({"#.", "#."}, {1, 0}, {0, 1}));
  EXPECT_FALSE(Allowed({"#.", "#."}, {1, 0}, {-1, 0}));
}

TEST(StepAllowed, CutsNoCornerOnADiagonal) {
  EXPECT_TRUE(Allowed({"..", ".."}, {0, 0}, {1, 1}));
  EXPECT_FALSE(Allowed({"#.", ".."}, {0, 0}, {1, 1}));
  EXPECT_FALSE(Allowed({"..", ".#"}, {0, 0}, {1, 1}));
  EXPECT_FALSE(Allowed({".#", ".."}, {0, 0}, {1, 1}));
}

TEST(StepAllowed, NeverLeavesTheRaster) {
  EXPECT_FALSE(Allowed({".."}, {0, 0}, {-1, 0}));
  EXPECT_FALSE(Allowed({".."}, {0, 0}, {1, 1}));
}

}  // namespace neighbours_test
}  // namespace plumescout
