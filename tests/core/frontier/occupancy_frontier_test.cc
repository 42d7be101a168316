// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/frontier/occupancy_frontier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <set>
#include <vector>

#include "core/grid/flood.h"
#include "core/grid/mask.h"
#include "core/grid/neighbours.h"
#include "core/occupancy/free_space.h"
#include "tests/support/grid_art.h"
#include "tests/support/random_grid.h"
#include "tests/support/slow_frontier.h"

namespace plumescout {
namespace occupancy_frontier_test {

using testing::ClustersOf;
using ::testing::ElementsAre;
using testing::GridArt;
using ::testing::IsEmpty;

std::vector<Frontier> Find(const GridArt& art, int min_cells = 1) {
  const Grid<CellState> states = testing::GridFromArt(art);
  return FindOccupancyFrontiers(states, TraversableCells(states, 0.0),
                                testing::CellsInArt(art, 'S'), min_cells);
}

// Unknown cells with a free 8-neighbour that the start reaches, in maximal clusters.
std::set<testing::Cluster> SlowFind(const Grid<CellState>& states, Cell start) {
  const Grid<std::uint8_t> reached = ReachableCells(MaskOf(states, CellState::kFree), {start});
  std::set<Cell> frontier;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Cell cell = states.geometry().CellAtIndex(i);
    if (states[i] == CellState::kUnknown &&
        testing::AnyNeighbour(cell, [&](Cell c) { return reached.At(c, 0) != 0; })) {
      frontier.insert(cell);
    }
  }
  return testing::MaximalClusters(frontier);
}

TEST(OccupancyFrontiers, EqualTheDefinitionOnRandomMaps) {
  Rng rng(1);
  int clusters = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Grid<CellState> states =
        testing::RandomStates(37, 29, 2 + static_cast<int>(rng.Below(8)), rng);
    const Cell start = testing::RandomCell(states.geometry(), rng);
    if (states[start] != CellState::kFree) continue;
    const std::vector<Frontier> frontiers =
        FindOccupancyFrontiers(states, TraversableCells(states, 0.2), {start}, 1);
    const std::set<testing::Cluster> expected = SlowFind(states, start);
    ASSERT_EQ(ClustersOf(frontiers), expected);
    ASSERT_EQ(frontiers.size(), expected.size());
    clusters += static_cast<int>(frontiers.size());
  }
  EXPECT_GT(clusters, 100);
}

// The frontier cells in the order in which a plain queue of cells meets them.
std::vector<Cell> SlowOrder(const Grid<CellState>& states, Cell start) {
  const auto state = [&](Cell cell) { return states.At(cell, CellState::kOccupied); };
  const auto is_free = [&](Cell cell) { return state(cell) == CellState::kFree; };
  std::vector<Cell> frontier;
  std::set<Cell> met = {start};
  std::deque<Cell> queue = {start};
  for (; !queue.empty(); queue.pop_front()) {
    for (const Cell offset : kNeighbours8) {
      const Cell to = Shifted(queue.front(), offset);
      if (is_free(to) && StepAllowed(queue.front(), offset, is_free)) {
        if (met.insert(to).second) queue.push_back(to);
      } else if (state(to) == CellState::kUnknown) {
        if (met.insert(to).second) frontier.push_back(to);
      }
    }
  }
  return frontier;
}

TEST(OccupancyFrontiers, AreInTheOrderInWhichAWavefrontMeetsThem) {
  Rng rng(4);
  int clusters = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Grid<CellState> states =
        testing::RandomStates(37, 29, 2 + static_cast<int>(rng.Below(8)), rng);
    const Cell start = testing::RandomCell(states.geometry(), rng);
    if (states[start] != CellState::kFree) continue;
    std::set<Cell> found;
    std::size_t next = 0;
    const std::vector<Cell> order = SlowOrder(states, start);
    for (const Frontier& frontier :
         FindOccupancyFrontiers(states, TraversableCells(states, 0.2), {start}, 1)) {
      while (next < order.size() && found.count(order[next]) > 0) ++next;
      ASSERT_LT(next, order.size());
      ASSERT_EQ(frontier.cells.front(), order[next]);
      found.insert(frontier.cells.begin(), frontier.cells.end());
      ++clusters;
    }
  }
  EXPECT_GT(clusters, 100);
}

TEST(OccupancyFrontiers, AreFoundFromEveryStart) {
  Rng rng(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Grid<CellState> states = testing::RandomStates(37, 29, 6, rng);
    std::vector<Cell> starts;
    while (starts.size() < 3) {
      const Cell start = testing::RandomCell(states.geometry(), rng);
      if (states[start] == CellState::kFree) starts.push_back(start);
    }
    std::set<Cell> expected;
    for (const Cell start : starts) {
      for (const testing::Cluster& cluster : SlowFind(states, start)) {
        expected.insert(cluster.begin(), cluster.end());
      }
    }
    ASSERT_EQ(ClustersOf(FindOccupancyFrontiers(states, TraversableCells(states, 0.2), starts, 1)),
              testing::MaximalClusters(expected));
  }
}

TEST(OccupancyFrontiers, LieBeyondTheFreeCellsAndNotBehindWalls) {
  const GridArt art = {"??#?",  //
                       "S.#?",  //
                       "..#?"};
  EXPECT_THAT(Find(art).at(0).cells, ElementsAre(Cell{0, 2}, Cell{1, 2}));
  EXPECT_EQ(Find(art).size(), 1U);
}

TEST(OccupancyFrontiers, DoNotLieBesideFreeCellsThatNoStartReaches) {
  EXPECT_THAT(Find({"S#.?",  //
                    ".#.?"}),
              IsEmpty());
}

TEST(OccupancyFrontiers, DoNotLieBehindACornerThatNoRobotPasses) {
  EXPECT_THAT(Find({"#.?",  //
                    "S#?"}),
              IsEmpty());
}

TEST(OccupancyFrontiers, AreMarkedWhenTooSmall) {
  const std::vector<Frontier> frontiers = Find({"?#??",  //
                                                "S..."},
                                               2);
  ASSERT_EQ(frontiers.size(), 2U);
  for (const Frontier& frontier : frontiers) {
    EXPECT_EQ(frontier.too_small, frontier.cells.size() < 2U);
    EXPECT_EQ(frontier.kind, FrontierKind::kOccupancy);
  }
}

TEST(OccupancyFrontiers, AreFoundByARobotOnACellNotSeenYet) {
  const GridArt art = {"?#.?",  //
                       "S..#"};
  Grid<CellState> states = testing::GridFromArt(art);
  states[testing::CellInArt(art, 'S')] = CellState::kUnknown;
  const std::vector<Frontier> frontiers = FindOccupancyFrontiers(
      states, TraversableCells(states, 0.0), testing::CellsInArt(art, 'S'), 1);
  EXPECT_EQ(ClustersOf(frontiers), (std::set<testing::Cluster>{{{0, 0}, {0, 1}}, {{3, 1}}}));
}

TEST(OccupancyFrontiers, OfAKnownMapAreNone) {
  EXPECT_THAT(Find({"S.",  //
                    "##"}),
              IsEmpty());
}

TEST(OccupancyFrontiers, WithoutAStartOrOutsideTheMapAreNone) {
  const Grid<CellState> states = testing::GridFromArt({".?"});
  const Grid<std::uint8_t> traversable = TraversableCells(states, 0.0);
  EXPECT_THAT(FindOccupancyFrontiers(states, traversable, {}, 1), IsEmpty());
  EXPECT_THAT(FindOccupancyFrontiers(states, traversable, {{-1, 0}, {0, 5}}, 1), IsEmpty());
  EXPECT_THAT(FindOccupancyFrontiers(Grid<CellState>(), Grid<std::uint8_t>(), {{0, 0}}, 1),
              IsEmpty());
}

}  // namespace occupancy_frontier_test
}  // namespace plumescout
