// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/regrid.h"

#include "gtest/gtest.h"

namespace plumescout {
namespace regrid_test {

TEST(Regridded, KeepsEveryCellAtItsPlaceInTheWorld) {
  const GridGeometry small{-0.3, 0.2, 0.1, 4, 3};
  Grid<int> grid(small);
  for (std::size_t i = 0; i < grid.size(); ++i) grid[i] = static_cast<int>(i) + 1;
  const GridGeometry large{-0.8, -0.4, 0.1, 12, 11};
  const Grid<int> result = Regridded(grid, large, -1);
  int found = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Cell source = small.CellAt(large.Center(large.CellAtIndex(i)));
    EXPECT_EQ(result[i], grid.At(source, -1));
    found += result[i] != -1;
  }
  EXPECT_EQ(found, 12);
}

TEST(Regridded, DropsWhatLiesBeyondASmallerGeometry) {
  Grid<int> grid(GridGeometry{0.0, 0.0, 1.0, 2, 2}, 7);
  const Grid<int> result = Regridded(grid, GridGeometry{1.0, 1.0, 1.0, 1, 2}, 0);
  EXPECT_EQ(result.values(), (std::vector<int>{7, 0}));
}

TEST(Regridded, OfTheSameGeometryIsTheSame) {
  const Grid<int> grid(GridGeometry{0.0, 0.0, 0.5, 3, 1}, 4);
  EXPECT_EQ(Regridded(grid, grid.geometry(), 0), grid);
}

}  // namespace regrid_test
}  // namespace plumescout
