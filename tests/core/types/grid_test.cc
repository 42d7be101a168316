// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/grid.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace grid_test {

TEST(Grid, HoldsItsFillEverywhere) {
  const Grid<int> grid(GridGeometry{0.0, 0.0, 0.1, 3, 2}, 7);
  EXPECT_EQ(grid.size(), 6U);
  for (std::size_t i = 0; i < grid.size(); ++i) EXPECT_EQ(grid[i], 7);
}

TEST(Grid, IsReadByCellAsByIndex) {
  Grid<int> grid(GridGeometry{0.0, 0.0, 0.1, 3, 2});
  grid[Cell{2, 1}] = 5;
  EXPECT_EQ(grid[5], 5);
  grid[0] = 4;
  EXPECT_EQ((grid[Cell{0, 0}]), 4);
}

TEST(Grid, AnswersOutsideWithTheValueGiven) {
  const Grid<int> grid(GridGeometry{0.0, 0.0, 0.1, 3, 2}, 7);
  EXPECT_EQ(grid.At({2, 1}, -1), 7);
  EXPECT_EQ(grid.At({3, 1}, -1), -1);
  EXPECT_EQ(grid.At({0, -1}, -1), -1);
}

TEST(Grid, IsEmptyByDefault) {
  EXPECT_EQ(Grid<int>().size(), 0U);
  EXPECT_FALSE(Grid<int>().Contains({0, 0}));
}

TEST(Grid, EqualsAnotherOfTheSamePlaceAndValues) {
  const Grid<int> grid(GridGeometry{0.0, 0.0, 0.1, 3, 2}, 7);
  EXPECT_EQ(grid, Grid<int>(grid.geometry(), 7));
  EXPECT_NE(grid, Grid<int>(grid.geometry(), 8));
  EXPECT_NE(grid, Grid<int>(GridGeometry{0.1, 0.0, 0.1, 3, 2}, 7));
}

}  // namespace grid_test
}  // namespace plumescout
