// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/cost_search.h"

#include <gtest/gtest.h>

#include <vector>

#include "lab/worlds/grid_oracle.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace cost_search_test {

using testing::PathCase;

constexpr double kRounding = 1e-9;

std::vector<Cell> GoalCells(const PathCase& c) {
  std::vector<Cell> cells;
  for (const Goal& goal : c.goals) cells.push_back(goal.cell);
  return cells;
}

TEST(CostSearch, FindsTheCheapestWaysOfTheGridUnderEveryCost) {
  struct Price {
    CostKind kind;
    double alpha_per_m;
  };
  for (const Price price : {Price{CostKind::kUcb, 0.0}, Price{CostKind::kUcb, 5.0},
                            Price{CostKind::kVertices, 1.0}, Price{CostKind::kEuclidean, 0.0}}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const PathCase c(seed, {60, 50, 40, 5}, price.kind, price.alpha_per_m);
      CostSearch search(c.cost);
      ASSERT_TRUE(search.Run(c.start_cell, GoalCells(c), c.stop));
      const Grid<double> oracle = lab::OracleCosts(c.cost, c.start_cell, 8);
      for (const Goal& goal : c.goals) {
        const std::vector<Point2> way = search.WayTo(goal.cell, c.start);
        ASSERT_FALSE(way.empty());
        EXPECT_EQ(way.front(), c.start);
        EXPECT_EQ(way.back(), goal.position);
        EXPECT_NEAR(PathCost(c.cost, way), oracle[goal.cell], kRounding) << "seed " << seed;
      }
    }
  }
}

TEST(CostSearch, HasNoWayToWhatItCannotReach) {
  PathCase c(3);
  c.information.penalty = Grid<float>(c.open.geometry(), std::numeric_limits<float>::infinity());
  c.information.penalty[c.start_cell] = 1.0F;
  CostSearch search(c.cost);
  EXPECT_TRUE(search.Run(c.start_cell, {{0, 0}}, c.stop));
  EXPECT_TRUE(search.WayTo({0, 0}, c.start).empty());
}

TEST(CostSearch, StopsSoon) {
  const PathCase c(4);
  int polls = 0;
  CostSearch search(c.cost);
  EXPECT_FALSE(
      search.Run(c.start_cell, {{-1 + c.open.width(), 0}}, [&polls] { return ++polls > 0; }));
  EXPECT_EQ(polls, 1);
}

TEST(CostSearch, StaysWithinItsCells) {
  const PathCase c(5, {60, 50, 0, 1});
  const CellRect cells =
      CellRect::Sized(c.start_cell, 1, 1).Grown(3).Within(WholeRaster(c.cost.geometry()));
  CostSearch search(c.cost, cells, c.stop);
  EXPECT_TRUE(search.Run(c.start_cell, {cells.min}, c.stop));
  EXPECT_EQ(search.WayTo(cells.min, c.start).back(), c.cost.geometry().Center(cells.min));
}

TEST(CostSearch, ToldToStopBeforeItBeginsFindsNothing) {
  const PathCase c(4);
  const StopFn now = [] { return true; };
  CostSearch search(c.cost, WholeRaster(c.cost.geometry()), now);
  EXPECT_FALSE(search.Run(c.start_cell, {c.start_cell}, now));
  EXPECT_TRUE(search.WayTo(c.start_cell, c.start).empty());
}

}  // namespace cost_search_test
}  // namespace plumescout
