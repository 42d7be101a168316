// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/mask.h"

#include <gtest/gtest.h>

#include "core/types/cell_state.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace mask_test {

TEST(MaskOf, IsOneWhereTheGridHoldsTheValue) {
  const Grid<CellState> states = testing::GridFromArt({".#?",  //
                                                       "##."});
  EXPECT_EQ(testing::ArtFromMask(MaskOf(states, CellState::kOccupied)), ".#.\n##.\n");
  EXPECT_EQ(MaskOf(states, CellState::kFree).geometry(), states.geometry());
}

TEST(BoundsOf, IsTheLeastRectangleAroundTheValue) {
  const Grid<CellState> states = testing::GridFromArt({"#####",  //
                                                       "##.##",  //
                                                       "#.##.",  //
                                                       "#####"});
  const CellRect bounds = BoundsOf(states, CellState::kFree);
  EXPECT_EQ(bounds, CellRect({1, 1}, {5, 3}));
  EXPECT_EQ(BoundsOf(states, CellState::kOccupied), WholeRaster(states.geometry()));
  EXPECT_TRUE(BoundsOf(states, CellState::kUnknown).empty());
  EXPECT_TRUE(BoundsOf(Grid<CellState>(), CellState::kFree).empty());
}

TEST(MaskWhere, IsOneWhereThePredicateHolds) {
  Grid<double> grid(GridGeometry{0.0, 0.0, 0.1, 3, 1});
  grid.values() = {-1.0, 0.0, 2.0};
  EXPECT_EQ(testing::ArtFromMask(MaskWhere(grid, [](double v) { return v >= 0.0; })), ".##\n");
}

}  // namespace mask_test
}  // namespace plumescout
