// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/escape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/grid_art.h"

namespace plumescout {
namespace escape_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Cells drawn 'T' are traversable, 'S' is the start (free, or as `start_state` says).
std::vector<Cell> Escape(const testing::GridArt& art, CellState start_state = CellState::kFree) {
  Grid<CellState> states = testing::GridFromArt(art);
  const Cell start = testing::CellInArt(art, 'S');
  states[start] = start_state;
  return EscapePath(states, testing::MaskFromArt(art, ".S#?"), start);
}

TEST(EscapePath, OfATraversableStartIsTheStart) {
  const Grid<CellState> states = testing::GridFromArt({"..."});
  EXPECT_THAT(EscapePath(states, testing::MaskFromArt({"..."}), {1, 0}), ElementsAre(Cell{1, 0}));
}

TEST(EscapePath, LeadsThroughFreeCellsToTheNearestTraversableCell) {
  EXPECT_THAT(Escape({"T#.T",  //
                      "#S..",  //
                      "####"}),
              ElementsAre(Cell{1, 1}, Cell{2, 1}, Cell{3, 2}));
}

TEST(EscapePath, DoesNotLeaveFreeSpaceForTheUnknown) {
  EXPECT_THAT(Escape({"S?T",  //
                      ".?#",  //
                      "..T"}),
              ElementsAre(Cell{0, 2}, Cell{0, 1}, Cell{0, 0}, Cell{1, 0}, Cell{2, 0}));
}

TEST(EscapePath, FromAnUnknownStartMayCrossUnknownCells) {
  EXPECT_THAT(Escape({"S?T"}, CellState::kUnknown),
              ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{2, 0}));
}

TEST(EscapePath, LeavesAnOccupiedStartButEntersNoOccupiedCell) {
  EXPECT_THAT(Escape({"S.T"}, CellState::kOccupied),
              ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{2, 0}));
  EXPECT_THAT(Escape({"S#T"}, CellState::kOccupied), IsEmpty());
}

TEST(EscapePath, SqueezesThroughNoCorner) {
  EXPECT_THAT(Escape({"#T",  //
                      "S#"}),
              IsEmpty());
}

TEST(EscapePath, FromOutsideOrOnAnEmptyMapIsEmpty) {
  const Grid<CellState> states = testing::GridFromArt({"..."});
  EXPECT_THAT(EscapePath(states, testing::MaskFromArt({"..."}), {3, 0}), IsEmpty());
  EXPECT_THAT(EscapePath(Grid<CellState>(), Grid<std::uint8_t>(), {0, 0}), IsEmpty());
}

}  // namespace escape_test
}  // namespace plumescout
