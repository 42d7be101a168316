// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/grid_geometry.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace grid_geometry_test {

GridGeometry Geometry() { return {-6.4, 12.8, 0.1, 64, 128}; }

TEST(GridGeometry, IndexesRowByRowFromTheSouth) {
  EXPECT_EQ(Geometry().Index({0, 0}), 0U);
  EXPECT_EQ(Geometry().Index({63, 0}), 63U);
  EXPECT_EQ(Geometry().Index({0, 1}), 64U);
  EXPECT_EQ(Geometry().size(), 64U * 128U);
}

TEST(GridGeometry, IndexAndCellAreInverse) {
  for (std::size_t index = 0; index < Geometry().size(); ++index) {
    ASSERT_EQ(Geometry().Index(Geometry().CellAtIndex(index)), index);
  }
}

TEST(GridGeometry, ContainsItsCellsAndNoOther) {
  EXPECT_TRUE(Geometry().Contains({0, 0}));
  EXPECT_TRUE(Geometry().Contains({63, 127}));
  EXPECT_FALSE(Geometry().Contains({64, 0}));
  EXPECT_FALSE(Geometry().Contains({0, 128}));
  EXPECT_FALSE(Geometry().Contains({-1, 0}));
  EXPECT_FALSE(Geometry().Contains({0, -1}));
}

TEST(GridGeometry, HoldsACentreInItsCell) {
  for (std::size_t index = 0; index < Geometry().size(); ++index) {
    const Cell cell = Geometry().CellAtIndex(index);
    ASSERT_EQ(Geometry().CellAt(Geometry().Center(cell)), cell);
  }
}

TEST(GridGeometry, HoldsItsLowerAndLeftEdgesAlthoughTheyRound) {
  for (int k = 0; k < 64; ++k) {
    // -6.4 + k * 0.1 lies a hair beside the edge of column k.
    ASSERT_EQ(Geometry().CellAt({-6.4 + k * 0.1, 12.8 + k * 0.1}), (Cell{k, k}));
  }
}

TEST(GridGeometry, FindsCellsOutsideToo) {
  EXPECT_EQ(Geometry().CellAt({-6.45, 12.75}), (Cell{-1, -1}));
  EXPECT_EQ(Geometry().CellAt({0.05, 25.65}), (Cell{64, 128}));
}

TEST(GridGeometry, SaturatesFarOutside) {
  constexpr int kLimit = 1 << 30;
  EXPECT_EQ(Geometry().CellAt({1e300, -1e300}), (Cell{kLimit, -kLimit}));
}

}  // namespace grid_geometry_test
}  // namespace plumescout
