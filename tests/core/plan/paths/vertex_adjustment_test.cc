// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/vertex_adjustment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/plan/paths/cost_search.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace vertex_adjustment_test {

using testing::PathCase;

constexpr double kRounding = 1e-9;

ShortcutPath GridWay(const PathCase& c, const Goal& goal) {
  CostSearch search(c.cost);
  search.Run(c.start_cell, {goal.cell}, c.stop);
  ShortcutPath path;
  path.vertices = search.WayTo(goal.cell, c.start);
  path.cost = PathCost(c.cost, path.vertices);
  return path;
}

TEST(AdjustVertices, NeverMakesAPathDearerAndSayWhatItCosts) {
  double before = 0.0;
  double after = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PathCase c(seed);
    for (const Goal& goal : c.goals) {
      ShortcutPath path = GridWay(c, goal);
      const std::vector<Point2> way = path.vertices;
      const double cost = path.cost;
      EdgePrices prices(c.cost);
      AdjustVertices(prices, c.stop, path);
      EXPECT_LE(path.cost, cost + kRounding);
      EXPECT_NEAR(path.cost, PathCost(c.cost, path.vertices), kRounding);
      EXPECT_EQ(path.vertices.front(), way.front());
      EXPECT_EQ(path.vertices.back(), way.back());
      EXPECT_EQ(path.vertices.size(), way.size());
      EXPECT_TRUE(testing::StaysClear(c.information.penalty, path.vertices));
      before += cost;
      after += path.cost;
    }
  }
  EXPECT_LT(after, 0.99 * before);
}

TEST(AdjustVertices, LeavesNoVertexThatANeighbouringCellWouldServeBetter) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PathCase c(seed);
    ShortcutPath path = GridWay(c, c.goals.front());
    EdgePrices prices(c.cost);
    AdjustVertices(prices, c.stop, path);
    for (std::size_t i = 1; i + 1 < path.vertices.size(); ++i) {
      const Cell cell = c.open.geometry().CellAt(path.vertices[i]);
      for (const Cell offset : kNeighbours8) {
        const Cell to{cell.x + offset.x, cell.y + offset.y};
        if (!c.open.Contains(to)) continue;
        std::vector<Point2> moved = path.vertices;
        moved[i] = c.open.geometry().Center(to);
        EXPECT_GE(PathCost(c.cost, moved), path.cost * (1.0 - 1e-8)) << "seed " << seed;
      }
    }
  }
}

TEST(AdjustVertices, LeavesThePathAsItIsIfStopped) {
  const PathCase c(2);
  ShortcutPath path = GridWay(c, c.goals.front());
  const std::vector<Point2> way = path.vertices;
  EdgePrices prices(c.cost);
  AdjustVertices(
      prices, [] { return true; }, path);
  EXPECT_EQ(path.vertices, way);
  EXPECT_NEAR(path.cost, PathCost(c.cost, way), kRounding);
}

}  // namespace vertex_adjustment_test
}  // namespace plumescout
