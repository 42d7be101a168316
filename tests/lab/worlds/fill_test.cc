// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/fill.h"

#include <gtest/gtest.h>

namespace plumescout::lab {
namespace fill_test {

TEST(FillTest, SetsTheCellsOfTheRectangleThatThereAre) {
  Grid<int> grid({0.0, 0.0, 1.0, 4, 3}, 0);
  Fill({{2, -1}, {9, 2}}, 7, grid);
  Fill({{1, 2}, {2, 3}}, 5, grid);
  Fill({{4, 0}, {6, 3}}, 9, grid);
  EXPECT_EQ(grid.values(), (std::vector<int>{0, 0, 7, 7,  //
                                             0, 0, 7, 7,  //
                                             0, 5, 0, 0}));
}

}  // namespace fill_test
}  // namespace plumescout::lab
