// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/free_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/types/rng.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace free_space_test {

using testing::ArtFromMask;
using testing::GridFromArt;

// The definition, on centres in whole cells; squared radius as an exact number of hundredths.
Grid<std::uint8_t> SlowTraversable(const Grid<CellState>& states, int radius_percent_of_cell) {
  Grid<std::uint8_t> traversable(states.geometry());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Cell a = states.geometry().CellAtIndex(i);
    bool ok = states[i] == CellState::kFree;
    for (std::size_t j = 0; j < states.size(); ++j) {
      const Cell b = states.geometry().CellAtIndex(j);
      const int squared = (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
      const bool near = squared * 10'000 <= radius_percent_of_cell * radius_percent_of_cell;
      ok = ok && !(near && states[j] == CellState::kOccupied);
    }
    traversable[i] = ok ? 1 : 0;
  }
  return traversable;
}

TEST(TraversableCells, EqualTheDefinitionOnRandomMaps) {
  Rng rng(1);
  for (const int percent : {0, 50, 100, 141, 142, 200, 250, 300, 700}) {
    Grid<CellState> states(GridGeometry{0.0, 0.0, 0.1, 31, 22});
    for (CellState& state : states.values()) {
      const std::uint64_t draw = rng.Below(20);  // one in 20 unknown, one occupied
      state = draw == 0 ? CellState::kUnknown : CellState::kFree;
      if (draw == 1) state = CellState::kOccupied;
    }
    // The radius as an option gives it: 0.3 m at 0.1 m is a hair less than 3 cells.
    ASSERT_EQ(TraversableCells(states, percent / 1000.0), SlowTraversable(states, percent))
        << percent;
  }
}

TEST(TraversableCells, LieFartherThanTheRadiusFromAWallCentreToCentre) {
  EXPECT_EQ(ArtFromMask(TraversableCells(GridFromArt({".......",  //
                                                      ".......",  //
                                                      ".......",  //
                                                      "...#..."}),
                                         0.2)),
            "#######\n"
            "###.###\n"
            "##...##\n"
            "#.....#\n");
}

TEST(TraversableCells, AreNotNarrowedByUnknownCells) {
  EXPECT_EQ(ArtFromMask(TraversableCells(GridFromArt({"?.?."}), 0.2)), ".#.#\n");
}

TEST(TraversableCells, AreAllFreeCellsWithoutInflation) {
  EXPECT_EQ(ArtFromMask(TraversableCells(GridFromArt({".#.?"}), 0.0)), "#.#.\n");
}

TEST(TraversableCells, OfAnEmptyMapAreEmpty) {
  EXPECT_EQ(TraversableCells(Grid<CellState>(), 0.2).size(), 0U);
}

}  // namespace free_space_test
}  // namespace plumescout
