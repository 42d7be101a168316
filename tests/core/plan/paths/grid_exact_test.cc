// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/grid_exact.h"

#include <gtest/gtest.h>

#include "lab/worlds/grid_oracle.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace grid_exact_test {

using testing::PathCase;

constexpr double kRounding = 1e-9;

TEST(GridExact, ReachesEveryGoalNearTheBestStraightLines) {
  double found = 0.0;
  double best = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const PathCase c(seed, {60, 50, 40, 5});
    const Grid<double> oracle = lab::OracleCosts(c.cost, c.start_cell, 32);
    const PathResult result = GridExactPlanner().FindPaths(c.Problem());
    EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
    EXPECT_EQ(result.effort.goals_by_guard, 0);
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      ASSERT_TRUE(result.paths[i].has_value());
      EXPECT_EQ(result.paths[i]->source, PathSource::kGridSearch);
      EXPECT_NEAR(result.paths[i]->cost, PathCost(c.cost, result.paths[i]->vertices), kRounding);
      found += result.paths[i]->cost;
      best += oracle[c.goals[i].cell];
    }
  }
  EXPECT_LT(found, 1.01 * best);
}

TEST(GridExact, DependsOnNoSeed) {
  const PathCase c(3);
  EXPECT_EQ(GridExactPlanner().FindPaths(c.Problem(1)).paths,
            GridExactPlanner().FindPaths(c.Problem(2)).paths);
}

TEST(GridExact, SaysThatItWasStopped) {
  PathCase c(3);
  c.stop = [] { return true; };
  EXPECT_EQ(GridExactPlanner().FindPaths(c.Problem()).end, PlanEnd::kStopped);
}

TEST(GridExact, OfNoGoalsIsDone) {
  PathCase c(3);
  c.goals.clear();
  const PathResult result = GridExactPlanner().FindPaths(c.Problem());
  EXPECT_TRUE(result.paths.empty());
  EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
}

}  // namespace grid_exact_test
}  // namespace plumescout
