// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/anchored_states.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "absl/status/status.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace anchored_states_test {

using ::plumescout::testing::GridArt;
using ::plumescout::testing::GridFromArt;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The map with its lower left corner so many cells from the anchor's.
Grid<CellState> MapAt(int x_cells, int y_cells, const GridArt& art) {
  const Grid<CellState> here = GridFromArt(art);
  GridGeometry geometry = here.geometry();
  geometry.origin_x_m += x_cells * geometry.resolution_m;
  geometry.origin_y_m += y_cells * geometry.resolution_m;
  Grid<CellState> moved(geometry);
  moved.values() = here.values();
  return moved;
}

TEST(AnchoredStatesTest, TheFirstFreeCellsAreNews) {
  AnchoredStates states;
  EXPECT_THAT(*states.Update(Grid<CellState>()), IsEmpty());
  EXPECT_TRUE(states.empty());
  EXPECT_THAT(*states.Update(GridFromArt({".#?."})), ElementsAre(0, 3));
  EXPECT_THAT(*states.Update(GridFromArt({".#?."})), IsEmpty());
}

TEST(AnchoredStatesTest, ReportsCellsThatBecomeFreeOrAreSoNoMore) {
  AnchoredStates states;
  ASSERT_TRUE(states.Update(GridFromArt({"..#?"})).ok());
  EXPECT_THAT(*states.Update(GridFromArt({".#.#"})), ElementsAre(1, 2));
}

TEST(AnchoredStatesTest, CellsKeepTheirPlaceWhenTheMapGrows) {
  AnchoredStates states;
  ASSERT_TRUE(states.Update(GridFromArt({".#"})).ok());
  const auto changed = states.Update(MapAt(-2, -1, {"??.#.", "....."}));
  EXPECT_THAT(*changed, ElementsAre(0, 1, 2, 3, 4, 9));
  EXPECT_EQ(states.At(0), (AnchorCell{-2, -1}));
  EXPECT_TRUE(states.IsFree({0, 0}));
  EXPECT_FALSE(states.IsFree({1, 0}));
  EXPECT_TRUE(states.IsFree({2, 0}));
  EXPECT_FALSE(states.IsFree({3, 0}));  // beyond the map
}

TEST(AnchoredStatesTest, FreeCellsAreVisitedInOrder) {
  AnchoredStates states;
  ASSERT_TRUE(states.Update(GridFromArt({".#"})).ok());
  ASSERT_TRUE(states.Update(MapAt(-2, -1, {"??.#.", "....."})).ok());
  std::size_t visited = 0;
  std::size_t next = 0;
  states.ForEachFree([&](std::size_t index, AnchorCell cell) {
    EXPECT_GE(index, next) << "in order, and once";
    EXPECT_EQ(cell, states.At(index));
    EXPECT_TRUE(states.IsFree(cell));
    EXPECT_EQ(states.states().geometry().Index(states.CellAt(cell)), index);
    next = index + 1;
    ++visited;
  });
  EXPECT_EQ(visited, 7u);
}

TEST(AnchoredStatesTest, WhatANewMapLeavesOutIsUnknown) {
  AnchoredStates states;
  ASSERT_TRUE(states.Update(GridFromArt({"..."})).ok());
  const auto changed = states.Update(MapAt(1, 1, {"...."}));
  EXPECT_THAT(*changed, ElementsAre(0, 1, 2, 6, 7, 8, 9));
  EXPECT_FALSE(states.IsFree({0, 0}));
  EXPECT_TRUE(states.IsFree({4, 1}));
}

TEST(AnchoredStatesTest, RefusesAnotherLatticeAndChangesNothing) {
  AnchoredStates states;
  ASSERT_TRUE(states.Update(GridFromArt({".#"})).ok());
  Grid<CellState> between = GridFromArt({".."});
  GridGeometry geometry = between.geometry();
  for (const double origin_m : {0.05, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    geometry.origin_x_m = origin_m;
    EXPECT_TRUE(absl::IsInvalidArgument(
        states.Update(Grid<CellState>(geometry, CellState::kFree)).status()));
  }
  EXPECT_TRUE(absl::IsInvalidArgument(states.Update(GridFromArt({".."}, 0.2)).status()));
  EXPECT_FALSE(states.IsFree({1, 0}));
}

}  // namespace anchored_states_test
}  // namespace plumescout
