// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/padded.h"

#include <gtest/gtest.h>

#include "tests/support/random_grid.h"

namespace plumescout {
namespace padded_test {

GridGeometry SmallGeometry() {
  GridGeometry geometry;
  geometry.width = 3;
  geometry.height = 2;
  return geometry;
}

TEST(Padded, HoldsTheFillInsideAndTheBorderAround) {
  const Padded<int> padded(SmallGeometry(), -1, 7);
  for (int y = -1; y <= 2; ++y) {
    for (int x = -1; x <= 3; ++x) {
      const bool inside = SmallGeometry().Contains({x, y});
      EXPECT_EQ(padded[padded.IndexOf({x, y})], inside ? 7 : -1) << x << ", " << y;
    }
  }
}

TEST(Padded, IndexAndCellAreInverse) {
  const Padded<int> padded(SmallGeometry(), 0, 0);
  for (int y = -1; y <= 2; ++y) {
    for (int x = -1; x <= 3; ++x) {
      EXPECT_EQ(padded.CellAt(padded.IndexOf({x, y})), (Cell{x, y}));
    }
  }
}

TEST(Padded, OffsetsLeadToTheNeighboursInTheirOrder) {
  const Padded<int> padded(SmallGeometry(), 0, 0);
  const Cell cell = {1, 1};
  for (std::size_t k = 0; k < kNeighbours8.size(); ++k) {
    EXPECT_EQ(padded.IndexOf(cell) + padded.NeighbourOffsets()[k],
              padded.IndexOf(Shifted(cell, kNeighbours8[k])));
  }
}

TEST(Padded, ComesBackAsTheGridItWasMadeFrom) {
  Rng rng(1);
  const Grid<std::uint8_t> grid = testing::RandomMask(17, 5, 0.5, rng);
  const auto same = [](std::uint8_t value) { return value; };
  const Padded<std::uint8_t> padded = PaddedFrom<std::uint8_t>(grid, 9, same);
  EXPECT_EQ(padded[padded.IndexOf({-1, 2})], 9);
  EXPECT_EQ(GridFrom<std::uint8_t>(padded, grid.geometry(), same), grid);
}

TEST(Padded, HoldsARectangleOutOfARaster) {
  Rng rng(2);
  const Grid<std::uint8_t> grid = testing::RandomMask(17, 9, 0.5, rng);
  const CellRect cells({4, 2}, {9, 8});
  const auto same = [](std::uint8_t value) { return value; };
  const Padded<std::uint8_t> padded = PaddedFrom<std::uint8_t>(grid, cells, 9, same);
  for (int y = 1; y < 9; ++y) {
    for (int x = 3; x < 10; ++x) {
      const int index = padded.IndexOf({x, y});
      EXPECT_EQ(padded.CellAt(index), (Cell{x, y}));
      const int expected = cells.Contains({x, y}) ? grid.At({x, y}, 0) : 9;
      EXPECT_EQ(padded[index], expected);
    }
  }
}

TEST(Padded, OfAnEmptyRasterIsAllBorder) {
  const Padded<int> padded(GridGeometry{}, 5, 0);
  EXPECT_EQ(padded[padded.IndexOf({-1, -1})], 5);
  EXPECT_EQ(padded[padded.IndexOf({0, 0})], 5);
}

}  // namespace padded_test
}  // namespace plumescout
