// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/level_of_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/server/maps/random_map.h"

namespace plumescout::server {
namespace level_of_detail_test {

// The worst state and the largest value of a square, cell by cell.
struct Oracle {
  bool occupied = false;
  bool unknown = false;
  float largest = std::numeric_limits<float>::quiet_NaN();
};

Oracle LookAt(const RandomMap& map, int level, Cell square) {
  Oracle oracle;
  for (int y = 0; y < map.states.height(); ++y) {
    for (int x = 0; x < map.states.width(); ++x) {
      if (x / (1 << level) != square.x || y / (1 << level) != square.y) continue;
      const CellState state = map.states[Cell{x, y}];
      oracle.occupied |= state == CellState::kOccupied;
      oracle.unknown |= state == CellState::kUnknown;
      const float value = map.values[Cell{x, y}];
      if (!std::isnan(value)) oracle.largest = std::fmax(oracle.largest, value);
    }
  }
  return oracle;
}

TEST(LevelOfDetailTest, SquaresAreTheWorstAndTheLargestOfTheirCells) {
  Rng rng(7);
  const RandomMap map = MakeRandomMap({-6.4, 0.0, 0.1, 37, 21}, rng);
  for (int level = 0; level <= kMaxLevelOfDetail; ++level) {
    const GridGeometry squares = SquaresOf(map.states.geometry(), level);
    EXPECT_EQ(squares.resolution_m, 0.1 * (1 << level));
    const CellRect rect{{squares.width / 2, 0}, {squares.width, squares.height}};
    const auto states = WorstStates(map.states, level, rect);
    const auto values = LargestValues(map.values, level, rect);
    for (int y = 0; y < rect.height(); ++y) {
      for (int x = 0; x < rect.width(); ++x) {
        const Oracle oracle = LookAt(map, level, {rect.min.x + x, rect.min.y + y});
        const CellState worst = oracle.occupied  ? CellState::kOccupied
                                : oracle.unknown ? CellState::kUnknown
                                                 : CellState::kFree;
        EXPECT_EQ((states[Cell{x, y}]), worst);
        const float value = values[Cell{x, y}];
        EXPECT_TRUE(value == oracle.largest || (std::isnan(value) && std::isnan(oracle.largest)));
      }
    }
  }
}

TEST(LevelOfDetailTest, SquaresAtTheBorderHoldTheCellsThatThereAre) {
  const GridGeometry cells{0.0, 0.0, 0.5, 9, 5};
  EXPECT_EQ(SquaresOf(cells, 2), (GridGeometry{0.0, 0.0, 2.0, 3, 2}));
  const CellRect last = CellsOf({{2, 1}, {3, 2}}, 2, cells);
  EXPECT_EQ(last, (CellRect{{8, 4}, {9, 5}}));
}

TEST(LevelOfDetailTest, MapWithoutCellsHasNoSquares) {
  const GridGeometry none{0.0, 0.0, 0.1, 0, 0};
  EXPECT_EQ(SquaresOf(none, 3).size(), 0u);
  EXPECT_EQ(WorstStates(Grid<CellState>(none), 3, {}).size(), 0u);
}

}  // namespace level_of_detail_test
}  // namespace plumescout::server
