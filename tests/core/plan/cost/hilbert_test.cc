// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/cost/hilbert.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <vector>

namespace plumescout {
namespace hilbert_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<Cell> CurveOf(int width, int height) {
  std::vector<Cell> cells;
  ForEachCellAlongHilbert(width, height, [&cells](Cell cell) { cells.push_back(cell); });
  return cells;
}

TEST(Hilbert, GoesAroundASquareOfFour) {
  EXPECT_THAT(CurveOf(2, 2), ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{1, 1}, Cell{0, 1}));
}

TEST(Hilbert, OfAPowerOfTwoStepsFromNeighbourToNeighbour) {
  for (const int size : {1, 2, 4, 8, 64}) {
    const std::vector<Cell> curve = CurveOf(size, size);
    for (std::size_t i = 1; i < curve.size(); ++i) {
      EXPECT_EQ(std::abs(curve[i].x - curve[i - 1].x) + std::abs(curve[i].y - curve[i - 1].y), 1);
    }
  }
}

TEST(Hilbert, VisitsEveryCellOfAnyRasterOnce) {
  for (const Cell size : {Cell{160, 200}, Cell{1, 9}, Cell{33, 2}, Cell{7, 7}}) {
    const std::vector<Cell> curve = CurveOf(size.x, size.y);
    EXPECT_EQ(curve.size(), static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    EXPECT_EQ(std::set<Cell>(curve.begin(), curve.end()).size(), curve.size());
    for (const Cell cell : curve) EXPECT_TRUE(cell.x < size.x && cell.y < size.y);
  }
}

TEST(Hilbert, OfAnEmptyRasterIsEmpty) { EXPECT_THAT(CurveOf(0, 0), IsEmpty()); }

}  // namespace hilbert_test
}  // namespace plumescout
