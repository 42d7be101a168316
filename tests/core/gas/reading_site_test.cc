// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_site.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/types/rng.h"
#include "tests/core/gas/dense_field.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace {

using ::plumescout::testing::GridFromArt;

// Where a reading at `position` goes on the map itself.
Placement PlaceAt(Point2 position, const Grid<CellState>& states) {
  return Place(SiteOf(position, states.geometry()), 0, 0, GmrfGraph(states));
}

Cell CellOf(const Placement& placement, const Grid<CellState>& states) {
  return states.geometry().CellAtIndex(GmrfGraph(states).cell_index(placement.variable));
}

TEST(PlaceTest, KeepsAReadingInItsOwnFreeCell) {
  const Grid<CellState> states = GridFromArt({"...", "...", "..."});
  const Placement placement = PlaceAt({0.11, 0.29}, states);
  EXPECT_EQ(CellOf(placement, states), (Cell{1, 2}));
  EXPECT_FALSE(placement.moved);
}

TEST(PlaceTest, MovesToTheSideOfAThinWallWhereTheReadingWas) {
  const Grid<CellState> states = GridFromArt({".#.", ".#.", ".#."});
  EXPECT_EQ(CellOf(PlaceAt({0.149, 0.15}, states), states), (Cell{0, 1}));
  EXPECT_EQ(CellOf(PlaceAt({0.151, 0.15}, states), states), (Cell{2, 1}));
  EXPECT_TRUE(PlaceAt({0.151, 0.15}, states).moved);
}

TEST(PlaceTest, MovesAcrossACornerIfNothingNearerIsFree) {
  const Grid<CellState> states = GridFromArt({"##.", "###", "###"});
  EXPECT_EQ(CellOf(PlaceAt({0.15, 0.15}, states), states), (Cell{2, 2}));
}

TEST(PlaceTest, BreaksTiesInAFixedOrder) {
  const Grid<CellState> all_but_centre = GridFromArt({"...", ".#.", "..."});
  EXPECT_EQ(CellOf(PlaceAt({0.15, 0.15}, all_but_centre), all_but_centre), (Cell{2, 1}));
  const Grid<CellState> corners = GridFromArt({".#.", "###", ".#."});
  EXPECT_EQ(CellOf(PlaceAt({0.15, 0.15}, corners), corners), (Cell{2, 2}));
}

TEST(PlaceTest, BreaksTiesWhateverTheRoundingOfThePosition) {
  const Grid<CellState> states = GridFromArt({"...", ".#.", "..."});
  for (const double noise_m : {-1e-12, 0.0, 1e-12}) {
    EXPECT_EQ(CellOf(PlaceAt({0.15 + noise_m, 0.15 - noise_m}, states), states), (Cell{2, 1}));
  }
}

TEST(PlaceTest, WaitsIfNothingWithinOneCellIsFree) {
  const Grid<CellState> states = GridFromArt({".....", ".###.", ".###.", ".###.", "....."});
  EXPECT_EQ(PlaceAt({0.25, 0.25}, states).variable, VariableIndex::kNone);
}

TEST(PlaceTest, MovesAReadingFromJustBeyondTheGrid) {
  const Grid<CellState> states = GridFromArt({"..", ".."});
  EXPECT_EQ(CellOf(PlaceAt({-0.05, 0.15}, states), states), (Cell{0, 1}));
  EXPECT_EQ(PlaceAt({-0.15, 0.15}, states).variable, VariableIndex::kNone);
}

TEST(PlaceTest, WaitsForAnyPositionFarAway) {
  const Grid<CellState> states = GridFromArt({"..", ".."});
  constexpr double kHuge = std::numeric_limits<double>::max();
  for (const Point2 position : {Point2{1e9, 0.0}, Point2{-kHuge, kHuge}, Point2{0.05, kHuge}}) {
    EXPECT_EQ(PlaceAt(position, states).variable, VariableIndex::kNone);
  }
}

TEST(PlaceTest, FollowsAnOriginThatMoved) {
  const ReadingSite site = SiteOf({0.05, 0.05}, GridFromArt({"."}).geometry());
  const Grid<CellState> grown = GridFromArt({"?????",  //
                                             "???.?",  //
                                             "?????"});
  EXPECT_FALSE(Place(site, 3, 1, GmrfGraph(grown)).moved);
  EXPECT_EQ(CellOf(Place(site, 3, 1, GmrfGraph(grown)), grown), (Cell{3, 1}));
  EXPECT_TRUE(Place(site, 2, 1, GmrfGraph(grown)).moved);
  EXPECT_EQ(Place(site, 1, 1, GmrfGraph(grown)).variable, VariableIndex::kNone);
}

// Distance from each neighbour's centre, straight from the definition.
TEST(PlaceTest, TakesTheNearestFreeCentre) {
  Rng rng(7);
  int moved = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Grid<CellState> states = testing::RandomStates(3, 3, 0.8, rng);
    states[Cell{1, 1}] = CellState::kOccupied;
    const Point2 position{rng.Uniform(0.1, 0.2), rng.Uniform(0.1, 0.2)};
    double nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i] != CellState::kFree) continue;
      const Point2 center = states.geometry().Center(states.geometry().CellAtIndex(i));
      nearest_m = std::min(nearest_m, Distance_m(position, center));
    }
    const Placement placement = PlaceAt(position, states);
    ASSERT_EQ(placement.variable == VariableIndex::kNone, std::isinf(nearest_m));
    if (placement.variable == VariableIndex::kNone) continue;
    ++moved;
    // Positions are compared in millionths of a cell: 1e-7 m.
    EXPECT_NEAR(Distance_m(position, states.geometry().Center(CellOf(placement, states))),
                nearest_m, 2e-7);
  }
  EXPECT_GT(moved, 1000);
}

}  // namespace
}  // namespace plumescout
