// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gmrf_graph.h"

#include <gtest/gtest.h>

#include "tests/support/grid_art.h"

namespace plumescout {
namespace gmrf_graph_test {

using ::plumescout::testing::GridFromArt;

TEST(GmrfGraphTest, NumbersFreeCellsInTheOrderOfTheGrid) {
  const GmrfGraph graph(GridFromArt({".#.",  //
                                     "?.."}));
  EXPECT_EQ(graph.variables(), 4);
  EXPECT_EQ(graph.At({1, 0}), VariableIndex{0});
  EXPECT_EQ(graph.At({2, 0}), VariableIndex{1});
  EXPECT_EQ(graph.At({0, 1}), VariableIndex{2});
  EXPECT_EQ(graph.At({2, 1}), VariableIndex{3});
  EXPECT_EQ(graph.cell_index(VariableIndex{2}), 3U);
}

TEST(GmrfGraphTest, HasNoVariableOnWallsUnknownCellsAndBeyondTheGrid) {
  const GmrfGraph graph(GridFromArt({".#", "?."}));
  for (const Cell cell : {Cell{1, 1}, Cell{0, 0}, Cell{-1, 0}, Cell{0, 2}, Cell{1 << 30, 0}}) {
    EXPECT_EQ(graph.At(cell), VariableIndex::kNone);
  }
}

TEST(GmrfGraphTest, ConnectsCellsThatShareAnEdge) {
  const GmrfGraph graph(GridFromArt({"..", ".."}));
  using Pair = std::array<VariableIndex, 2>;
  constexpr VariableIndex kNone = VariableIndex::kNone;
  EXPECT_EQ(graph.later_neighbours(VariableIndex{0}), (Pair{VariableIndex{1}, VariableIndex{2}}));
  EXPECT_EQ(graph.later_neighbours(VariableIndex{1}), (Pair{kNone, VariableIndex{3}}));
  EXPECT_EQ(graph.later_neighbours(VariableIndex{2}), (Pair{VariableIndex{3}, kNone}));
  EXPECT_EQ(graph.later_neighbours(VariableIndex{3}), (Pair{kNone, kNone}));
}

TEST(GmrfGraphTest, DoesNotConnectAcrossWallsCornersOrTheEdgeOfTheGrid) {
  const GmrfGraph graph(GridFromArt({".#.",  //
                                     "#?#",  //
                                     ".#."}));
  for (int i = 0; i < graph.variables(); ++i) {
    for (const VariableIndex neighbour : graph.later_neighbours(VariableIndex{i})) {
      EXPECT_EQ(neighbour, VariableIndex::kNone);
    }
  }
}

// The anchor lies at cell (1, 1); squares of 2 x 2 begin there. From the west: what is left of one,
// a whole one, and one behind a wall that only the northern row passes.
TEST(GmrfGraphTest, SquaresOfCellsAreFreeAndLinkedByTheirCells) {
  const Grid<CellState> states = GridFromArt({"...#.",  //
                                              "?.#..",  //
                                              "?....",  //
                                              "....."});
  const GmrfGraph graph(states, {-1, -1}, 2);
  EXPECT_EQ(graph.geometry().width, 3);
  EXPECT_EQ(graph.geometry().height, 3);
  EXPECT_NEAR(graph.geometry().origin_x_m, -0.1, 1e-12);
  EXPECT_NEAR(graph.geometry().resolution_m, 0.2, 1e-12);
  EXPECT_EQ(graph.variables(), 8) << "all but the western one of the middle row";
  EXPECT_EQ(graph.At({0, 1}), VariableIndex::kNone);
  const auto linked = [&](Cell from, Cell to) {
    const auto& next = graph.later_neighbours(graph.At(from));
    return next[0] == graph.At(to) || next[1] == graph.At(to);
  };
  EXPECT_TRUE(linked({0, 0}, {1, 0}));
  EXPECT_TRUE(linked({1, 1}, {2, 1})) << "past the wall";
  EXPECT_FALSE(linked({1, 2}, {2, 2})) << "a wall between them";
  EXPECT_TRUE(linked({0, 2}, {1, 2}));
  EXPECT_TRUE(linked({1, 1}, {1, 2}));
}

TEST(GmrfGraphTest, TakesTheEmptyGrid) { EXPECT_EQ(GmrfGraph(Grid<CellState>()).variables(), 0); }

}  // namespace gmrf_graph_test
}  // namespace plumescout
