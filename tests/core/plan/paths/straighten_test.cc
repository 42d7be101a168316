// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/straighten.h"

#include <gtest/gtest.h>

#include "core/plan/paths/xit.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace straighten_test {

using testing::PathCase;

constexpr double kRounding = 1e-9;

PathResult TreePaths(const PathCase& c) {
  PlanningOptions options;
  options.sample_count = 100;
  return XitPlanner(options).FindPaths(c.Problem());
}

TEST(Straighten, MakesThePathsOfATreeCheaper) {
  double before = 0.0;
  double after = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PathCase c(seed);
    EdgePrices prices(c.cost);
    for (const auto& path : TreePaths(c).paths) {
      if (!path) continue;
      PlanEffort effort;
      const FoundPath straight =
          Straighten(c.Problem(), path->vertices, PathSource::kTree, prices, effort);
      EXPECT_LE(straight.cost, path->cost + kRounding);
      EXPECT_NEAR(straight.cost, PathCost(c.cost, straight.vertices), kRounding);
      EXPECT_EQ(straight.vertices.front(), path->vertices.front());
      EXPECT_EQ(straight.vertices.back(), path->vertices.back());
      EXPECT_TRUE(testing::StaysClear(c.information.penalty, straight.vertices));
      EXPECT_EQ(straight.source, PathSource::kTree);
      before += path->cost;
      after += straight.cost;
    }
  }
  EXPECT_LT(after, 0.97 * before);
}

TEST(Straighten, LeavesAWayAloneIfOnlyItsVerticesCost) {
  const PathCase c(5, {}, CostKind::kVertices);
  const PathResult found = TreePaths(c);
  ASSERT_TRUE(found.paths.front().has_value());
  EdgePrices prices(c.cost);
  PlanEffort effort;
  const FoundPath path =
      Straighten(c.Problem(), found.paths.front()->vertices, PathSource::kTree, prices, effort);
  EXPECT_EQ(path.vertices, found.paths.front()->vertices);
  EXPECT_NEAR(path.cost, found.paths.front()->cost, kRounding);
}

TEST(Straighten, KeepsToTheEdgeBudget) {
  const PathCase c(5);
  const PathResult found = TreePaths(c);
  ASSERT_TRUE(found.paths.front().has_value());
  const std::vector<Point2>& way = found.paths.front()->vertices;
  PlanEffort spent;
  spent.edges_evaluated = 1000;
  EdgePrices prices(c.cost);
  const FoundPath path = Straighten(c.Problem(1, 1000), way, PathSource::kTree, prices, spent);
  EXPECT_EQ(path.vertices, way);
}

}  // namespace straighten_test
}  // namespace plumescout
