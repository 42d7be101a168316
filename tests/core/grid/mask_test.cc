// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/mask.h"

#include <gtest/gtest.h>

#include <array>

#include "core/types/cell_state.h"
#include "tests/support/grid_art.h"
#include "tests/support/random_grid.h"

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

// Of values of one byte and of several.
template <typename T>
void ExpectLeastRectangles(Rng& rng) {
  for (int trial = 0; trial < 100; ++trial) {
    const Grid<std::uint8_t> mask =
        testing::RandomMask(1 + trial % 23, 1 + trial % 17, 0.1 * rng.Uniform01(), rng);
    Grid<T> grid(mask.geometry());
    CellRect expected;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      grid[i] = static_cast<T>(mask[i]);
      if (mask[i] != 0) expected.Include(mask.geometry().CellAtIndex(i));
    }
    ASSERT_EQ(BoundsOf(grid, T{1}), expected);
  }
}

TEST(BoundsOf, IsTheLeastRectangleOnRandomMasks) {
  Rng rng(3);
  ExpectLeastRectangles<std::uint8_t>(rng);
  ExpectLeastRectangles<int>(rng);
}

TEST(BoundsOf, IsEmptyWithoutCells) {
  EXPECT_TRUE(BoundsOf(Grid<std::uint8_t>(), std::uint8_t{1}).empty());
  EXPECT_TRUE(
      BoundsOf(Grid<std::uint8_t>(GridGeometry{0.0, 0.0, 1.0, 0, 3}), std::uint8_t{1}).empty());
}

TEST(FirstOf, IsTheEndWithoutTheValue) {
  const std::array<std::uint8_t, 4> values = {0, 2, 1, 2};
  const std::uint8_t* const begin = values.data();
  EXPECT_EQ(FirstOf(begin, begin + 4, std::uint8_t{2}) - begin, 1);
  EXPECT_EQ(FirstOf(begin, begin + 4, std::uint8_t{3}) - begin, 4);
  EXPECT_EQ(FirstOf(begin, begin + 2, std::uint8_t{1}) - begin, 2);
  EXPECT_EQ(FirstOf(begin, begin, std::uint8_t{0}) - begin, 0);
}

TEST(MaskWhere, IsOneWhereThePredicateHolds) {
  Grid<double> grid(GridGeometry{0.0, 0.0, 0.1, 3, 1});
  grid.values() = {-1.0, 0.0, 2.0};
  EXPECT_EQ(testing::ArtFromMask(MaskWhere(grid, [](double v) { return v >= 0.0; })), ".##\n");
}

}  // namespace mask_test
}  // namespace plumescout
