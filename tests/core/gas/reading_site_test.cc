// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_site.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/types/rng.h"
#include "tests/core/gas/dense_field.h"
#include "tests/support/grid_art.h"

namespace plumescout {
namespace reading_site_test {

using ::plumescout::testing::GridFromArt;

// Where a reading at `position` goes on the map itself.
Placement PlaceAt(Point2 position, const Grid<CellState>& states) {
  return PlacementOf(SiteOf(position, states.geometry()), states, AnchorCell{0, 0});
}

AnchorCell CellOf(Point2 position, const Grid<CellState>& states) {
  return PlaceAt(position, states).cell.value();
}

TEST(PlacementOfTest, KeepsAReadingInItsOwnFreeCell) {
  const Grid<CellState> states = GridFromArt({"...", "...", "..."});
  EXPECT_EQ(PlaceAt({0.11, 0.29}, states), (Placement{AnchorCell{1, 2}, false}));
}

TEST(PlacementOfTest, MovesToTheSideOfAThinWallWhereTheReadingWas) {
  const Grid<CellState> states = GridFromArt({".#.", ".#.", ".#."});
  EXPECT_EQ(CellOf({0.149, 0.15}, states), (AnchorCell{0, 1}));
  EXPECT_EQ(CellOf({0.151, 0.15}, states), (AnchorCell{2, 1}));
  EXPECT_TRUE(PlaceAt({0.151, 0.15}, states).moved);
}

TEST(PlacementOfTest, MovesAcrossACornerIfNothingNearerIsFree) {
  const Grid<CellState> states = GridFromArt({"##.", "###", "###"});
  EXPECT_EQ(CellOf({0.15, 0.15}, states), (AnchorCell{2, 2}));
}

TEST(PlacementOfTest, BreaksTiesInAFixedOrder) {
  const Grid<CellState> all_but_centre = GridFromArt({"...", ".#.", "..."});
  EXPECT_EQ(CellOf({0.15, 0.15}, all_but_centre), (AnchorCell{2, 1}));
  const Grid<CellState> corners = GridFromArt({".#.", "###", ".#."});
  EXPECT_EQ(CellOf({0.15, 0.15}, corners), (AnchorCell{2, 2}));
}

TEST(PlacementOfTest, BreaksTiesWhateverTheRoundingOfThePosition) {
  const Grid<CellState> states = GridFromArt({"...", ".#.", "..."});
  for (const double noise_m : {-1e-12, 0.0, 1e-12}) {
    EXPECT_EQ(CellOf({0.15 + noise_m, 0.15 - noise_m}, states), (AnchorCell{2, 1}));
  }
}

TEST(PlacementOfTest, WaitsIfNothingWithinOneCellIsFree) {
  const Grid<CellState> states = GridFromArt({".....", ".###.", ".###.", ".###.", "....."});
  EXPECT_EQ(PlaceAt({0.25, 0.25}, states), Placement());
}

TEST(PlacementOfTest, MovesAReadingFromJustBeyondTheGrid) {
  const Grid<CellState> states = GridFromArt({"..", ".."});
  EXPECT_EQ(CellOf({-0.05, 0.15}, states), (AnchorCell{0, 1}));
  EXPECT_EQ(PlaceAt({-0.15, 0.15}, states), Placement());
}

TEST(PlacementOfTest, WaitsForAnyPositionFarAway) {
  const Grid<CellState> states = GridFromArt({"..", ".."});
  constexpr double kHuge = std::numeric_limits<double>::max();
  for (const Point2 position : {Point2{1e9, 0.0}, Point2{-kHuge, kHuge}, Point2{0.05, kHuge}}) {
    EXPECT_EQ(PlaceAt(position, states), Placement());
  }
}

TEST(PlacementOfTest, FollowsAnOriginThatMoved) {
  const ReadingSite site = SiteOf({0.05, 0.05}, GridFromArt({"."}).geometry());
  const Grid<CellState> grown = GridFromArt({"?????",  //
                                             "???.?",  //
                                             "?????"});
  EXPECT_EQ(PlacementOf(site, grown, {-3, -1}), (Placement{AnchorCell{0, 0}, false}));
  EXPECT_EQ(PlacementOf(site, grown, {-2, -1}), (Placement{AnchorCell{1, 0}, true}));
  EXPECT_EQ(PlacementOf(site, grown, {-1, -1}), Placement());
}

TEST(SiteOfTest, FindsTheCentreOfACell) {
  const GridGeometry anchor = GridFromArt({"."}).geometry();
  EXPECT_EQ(SiteOf({0.35, -0.15}, anchor), CentreOf({3, -2}));
  EXPECT_NE(SiteOf({0.36, -0.15}, anchor), CentreOf({3, -2}));
}

// Truncation of 4.3 / 0.1 and the like puts one index in twenty a cell off.
TEST(SiteOfTest, FindsTheCellOfEveryCornerAndCentre) {
  const GridGeometry anchor = GridFromArt({"."}).geometry();
  for (int k = -300; k < 300; ++k) {
    EXPECT_EQ(SiteOf({k * 0.1, 0.0}, anchor).cell, (AnchorCell{k, 0}));
    EXPECT_EQ(SiteOf({(k + 0.5) * 0.1, 0.0}, anchor).cell, (AnchorCell{k, 0}));
  }
}

// The readings of a doorway that fills up do not leave for another room.
TEST(PlacementOfTest, CrossesNoCornerIfASideIsFree) {
  const Grid<CellState> states = GridFromArt({"?#.",  //
                                              ".##",  //
                                              "###"});
  EXPECT_EQ(CellOf({0.199, 0.199}, states), (AnchorCell{0, 1}));
}

TEST(SiteOfTest, KnowsSoManySitesInACell) {
  const GridGeometry anchor = GridFromArt({"."}).geometry();
  std::set<ReadingSite> sites;
  for (int y = 0; y <= 100; ++y) {
    for (int x = 0; x <= 100; ++x) sites.insert(SiteOf({0.001 * x, 0.001 * y}, anchor));
  }
  std::erase_if(sites, [](const ReadingSite& site) { return site.cell != AnchorCell{0, 0}; });
  EXPECT_EQ(sites.size(), kSitesPerCell);
}

// Distance from each neighbour's centre, straight from the definition.
TEST(PlacementOfTest, TakesTheNearestFreeCentreAcrossASideElseACorner) {
  constexpr double kFar_m = std::numeric_limits<double>::infinity();
  Rng rng(7);
  int moved = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Grid<CellState> states = testing::RandomStates(3, 3, 0.8, rng);
    states[Cell{1, 1}] = CellState::kOccupied;
    const Point2 position{rng.Uniform(0.1, 0.2), rng.Uniform(0.1, 0.2)};
    double nearest_m[] = {kFar_m, kFar_m};  // across a side, across a corner
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i] != CellState::kFree) continue;
      const Cell cell = states.geometry().CellAtIndex(i);
      double& nearest = nearest_m[cell.x != 1 && cell.y != 1];
      nearest = std::min(nearest, Distance_m(position, states.geometry().Center(cell)));
    }
    const double expected_m = std::isfinite(nearest_m[0]) ? nearest_m[0] : nearest_m[1];
    const Placement placement = PlaceAt(position, states);
    ASSERT_EQ(placement.cell.has_value(), std::isfinite(expected_m));
    if (!placement.cell) continue;
    ++moved;
    // Positions are compared in millionths of a cell: 1e-7 m.
    const Cell cell{placement.cell->x, placement.cell->y};
    EXPECT_NEAR(Distance_m(position, states.geometry().Center(cell)), expected_m, 2e-7);
  }
  EXPECT_GT(moved, 1000);
}

}  // namespace reading_site_test
}  // namespace plumescout
