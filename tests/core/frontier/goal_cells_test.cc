// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/goal_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "core/frontier/occupancy_frontier.h"
#include "core/grid/escape.h"
#include "core/grid/grid_search.h"
#include "core/grid/mask.h"
#include "core/occupancy/free_space.h"
#include "tests/support/grid_art.h"
#include "tests/support/random_grid.h"
#include "tests/support/slow_frontier.h"

namespace plumescout {
namespace goal_cells_test {

using testing::CellInArt;
using testing::CellsInArt;
using ::testing::ElementsAre;
using testing::GridArt;
using ::testing::IsEmpty;

// Lengths in float, of ways of at most a few hundred steps.
constexpr double kTolerance_m = 1e-3;

Frontier FrontierOf(std::vector<Cell> cells, const GridGeometry& geometry) {
  Frontier frontier;
  frontier.cells = std::move(cells);
  for (const Cell cell : frontier.cells) {
    const auto count = static_cast<double>(frontier.cells.size());
    frontier.centroid.x_m += geometry.Center(cell).x_m / count;
    frontier.centroid.y_m += geometry.Center(cell).y_m / count;
  }
  return frontier;
}

// Traversable 'T' (and 'S' the start, if `start_traversable`), free '.', frontier cells '?'.
Frontier GoalIn(const GridArt& art, bool start_traversable = true) {
  const Grid<CellState> states = testing::GridFromArt(art);
  const Grid<std::uint8_t> traversable =
      testing::MaskFromArt(art, start_traversable ? ".#?" : ".#?S");
  std::vector<Frontier> frontiers = {FrontierOf(CellsInArt(art, '?'), states.geometry())};
  FindGoalCells(states, traversable, CellsInArt(art, 'S'), frontiers);
  return frontiers[0];
}

TEST(GoalCells, LieAtTheReachedTraversableCellNearestToTheMiddleOfTheCluster) {
  const Frontier frontier = GoalIn({".????",  //
                                    ".....",  //
                                    "TTTTT",  //
                                    "STTTT"});
  EXPECT_TRUE(frontier.reachable);
  // The anchor is (2,3), of the two middle cells the one of lower index.
  EXPECT_EQ(frontier.goal_cell, (Cell{2, 1}));
  EXPECT_NEAR(frontier.travel_m, 0.1 * (1.0 + std::sqrt(2.0)), kTolerance_m);
}

TEST(GoalCells, OfARingLieOnTheRingAndNotWhereTheRobotStands) {
  const Frontier frontier = GoalIn({"?????",  //
                                    "?TTT?",  //
                                    "?TST?",  //
                                    "?TTT?",  //
                                    "?????"});
  EXPECT_TRUE(frontier.reachable);
  EXPECT_NE(frontier.goal_cell, (Cell{2, 2}));
}

TEST(GoalCells, AreTheAnchorItselfIfItIsReached) {
  const GridArt art = {"STTTT"};
  const Grid<CellState> states = testing::GridFromArt(art);
  std::vector<Frontier> frontiers = {FrontierOf({{2, 0}, {3, 0}, {4, 0}}, states.geometry())};
  FindGoalCells(states, testing::MaskFromArt(art), {{0, 0}}, frontiers);
  EXPECT_EQ(frontiers[0].goal_cell, (Cell{3, 0}));
  EXPECT_NEAR(frontiers[0].travel_m, 0.3, kTolerance_m);
}

TEST(GoalCells, AreNearByTravelAndNotThroughAWall) {
  // Straight across the wall (2,0) is nearer to the cluster than (6,1), but not by travel.
  const Frontier frontier = GoalIn({"?.....T",  //
                                    "######T",  //
                                    "STTTTTT"});
  EXPECT_EQ(frontier.goal_cell, (Cell{6, 2}));
}

TEST(GoalCells, LieAtTheEndOfWaysOfAnyLength) {
  for (std::size_t length = 1; length < 60; ++length) {
    const std::string between(length, '.');
    const std::string wall(length, '#');
    const Frontier frontier = GoalIn({"ST" + wall + "#",     //
                                      "TT" + between + "?",  //
                                      "TT" + wall + "#"});
    ASSERT_TRUE(frontier.reachable);
    ASSERT_EQ(frontier.goal_cell, (Cell{1, 1})) << length;
  }
}

TEST(GoalCells, AreThoseOfShortestWaysAndNotOfFewestSteps) {
  const Frontier frontier = GoalIn({"TTTTTTTTT",    //
                                    "T#######T",    // three diagonal steps to the frontier
                                    "#.######T",    //
                                    "##.#####T",    //
                                    "###?...TS"});  // four straight ones
  EXPECT_EQ(frontier.goal_cell, (Cell{7, 0}));
}

TEST(GoalCells, CountTheWayOutOfTheInflatedZone) {
  const Frontier frontier = GoalIn({"S.TT?"}, /*start_traversable=*/false);
  EXPECT_EQ(frontier.goal_cell, (Cell{3, 0}));
  EXPECT_NEAR(frontier.travel_m, 0.3, kTolerance_m);
}

TEST(GoalCells, AreMissingWhereNoStartGetsAnywhere) {
  EXPECT_FALSE(GoalIn({"S..?"}, /*start_traversable=*/false).reachable);
  EXPECT_FALSE(GoalIn({"S#T?"}).reachable);
}

TEST(GoalCells, AreMissingWithoutAStart) { EXPECT_FALSE(GoalIn({"TT?"}).reachable); }

TEST(GoalCells, OfNoFrontiersAreNone) {
  std::vector<Frontier> frontiers;
  FindGoalCells(Grid<CellState>(), Grid<std::uint8_t>(), {{0, 0}}, frontiers);
  EXPECT_THAT(frontiers, IsEmpty());
}

// By definition: of all reached traversable cells that from which the way to the anchor, over free
// and frontier cells, is shortest. Returns that length; infinite if there is no such cell.
double LeastLastBit_m(const Grid<CellState>& states, const Grid<double>& travel_m,
                      const std::vector<Frontier>& frontiers, Cell anchor) {
  Grid<std::uint8_t> passable = MaskOf(states, CellState::kFree);
  for (const Frontier& frontier : frontiers) {
    for (const Cell cell : frontier.cells) passable[cell] = 1;
  }
  const Grid<double> from_anchor_m =
      TravelDistances_m(passable, std::vector<Cell>{anchor}, Connectivity::kEight);
  double least_m = kUnreached_m;
  for (std::size_t i = 0; i < travel_m.size(); ++i) {
    if (travel_m[i] < kUnreached_m) least_m = std::min(least_m, from_anchor_m[i]);
  }
  return least_m;
}

// The cell least far from the mean of all, ties by index; in integers.
Cell SlowAnchor(const Frontier& frontier, const GridGeometry& geometry) {
  const auto squared_distance = [&](Cell cell) {
    std::int64_t dx = 0;
    std::int64_t dy = 0;
    for (const Cell other : frontier.cells) {
      dx += cell.x - other.x;
      dy += cell.y - other.y;
    }
    return dx * dx + dy * dy;
  };
  std::map<std::pair<std::int64_t, std::size_t>, Cell> by_distance;
  for (const Cell cell : frontier.cells) {
    by_distance[{squared_distance(cell), geometry.Index(cell)}] = cell;
  }
  return by_distance.begin()->second;
}

TEST(GoalCells, AreTraversableReachedAndNearestOnRandomMaps) {
  Rng rng(1);
  int goals = 0;
  int untraversable_anchors = 0;
  for (int trial = 0; trial < 80; ++trial) {
    const Grid<CellState> states = testing::RandomStates(41, 33, 7, rng);
    const Grid<std::uint8_t> traversable = TraversableCells(states, 0.2);
    const Cell start = testing::RandomCell(states.geometry(), rng);
    const std::vector<Frontier> frontiers = FindOccupancyFrontiers(states, traversable, {start}, 1);
    const std::vector<Cell> escape = EscapePath(states, traversable, start);
    const std::vector<SearchSource> sources =
        escape.empty() ? std::vector<SearchSource>{}
                       : std::vector<SearchSource>{{escape.back(), PathLength_m(escape, 0.1)}};
    const Grid<double> travel_m = TravelDistances_m(traversable, sources);
    for (const Frontier& frontier : frontiers) {
      ASSERT_EQ(frontier.reachable, !escape.empty());
      if (!frontier.reachable) continue;
      ++goals;
      ASSERT_EQ(traversable[frontier.goal_cell], 1);
      ASSERT_NEAR(frontier.travel_m, travel_m[frontier.goal_cell], kTolerance_m);
      const Cell anchor = SlowAnchor(frontier, states.geometry());
      untraversable_anchors += traversable[anchor] == 0 ? 1 : 0;
      Grid<double> goal_only(states.geometry(), kUnreached_m);
      goal_only[frontier.goal_cell] = 0.0;
      ASSERT_NEAR(LeastLastBit_m(states, goal_only, frontiers, anchor),
                  LeastLastBit_m(states, travel_m, frontiers, anchor), kTolerance_m);
    }
  }
  EXPECT_GT(goals, 200);
  EXPECT_GT(untraversable_anchors, 200);
}

TEST(FreeStarts, KeepsFreeStartsAndMovesOthersToTheNearestFreeCell) {
  const Grid<CellState> states = testing::GridFromArt({".??.",  //
                                                       "####"});
  EXPECT_THAT(FreeStarts(states, {{0, 1}, {2, 1}, {9, 9}}), ElementsAre(Cell{0, 1}, Cell{3, 1}));
}

TEST(FreeStarts, DropsAStartWithNoFreeCellToGoTo) {
  EXPECT_THAT(FreeStarts(testing::GridFromArt({"?#."}), {{0, 0}}), IsEmpty());
}

}  // namespace goal_cells_test
}  // namespace plumescout
