// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/map_tiles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout {
namespace map_tiles_test {

TEST(MapTiles, CellsLieInTheTileThatDivisionSays) {
  for (std::int64_t cell = -200; cell <= 200; ++cell) {
    const double tile = std::floor(static_cast<double>(cell) / 64.0);
    EXPECT_EQ(TileOfCell(cell), static_cast<std::int64_t>(tile)) << cell;
  }
}

TEST(MapTiles, ACellAtTheEdgeOfATileNeedsTheNextOne) {
  EXPECT_EQ(TilesAround({}, 1, 62).cells(), 64);
  EXPECT_EQ(TilesAround({}, 0, 62).cells(), 128);
  EXPECT_EQ(TilesAround({}, 0, 63).cells(), 192);
}

TEST(MapTiles, TilesThatAreThereStay) {
  const TileSpan span = TilesAround({.begin = 3, .end = 5}, -10, -5);
  EXPECT_EQ(span.begin, -1);
  EXPECT_EQ(span.end, 5);
}

}  // namespace map_tiles_test
}  // namespace plumescout
