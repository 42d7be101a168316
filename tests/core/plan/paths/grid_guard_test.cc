// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/grid_guard.h"

#include <gtest/gtest.h>

#include "core/plan/paths/shortcut.h"
#include "lab/worlds/grid_oracle.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace grid_guard_test {

using testing::PathCase;

constexpr double kRounding = 1e-9;

PathResult NothingFound(const PathCase& c) {
  PathResult result;
  result.paths.resize(c.goals.size());
  return result;
}

PathResult Completed(const PathCase& c) {
  PathResult result = NothingFound(c);
  CompleteOnGrid(c.Problem(), PathSource::kGridGuard, result);
  return result;
}

TEST(GridGuard, ReachesEveryGoalThatCanBeReached) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const PathCase c(seed, {60, 50, 40, 5});
    const PathResult result = Completed(c);
    EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      ASSERT_TRUE(result.paths[i].has_value()) << "seed " << seed;
      EXPECT_EQ(result.paths[i]->source, PathSource::kGridGuard);
      EXPECT_EQ(result.paths[i]->vertices.front(), c.start);
      EXPECT_EQ(result.paths[i]->vertices.back(), c.goals[i].position);
      EXPECT_TRUE(testing::StaysClear(c.information.penalty, result.paths[i]->vertices));
      EXPECT_NEAR(result.paths[i]->cost, PathCost(c.cost, result.paths[i]->vertices), kRounding);
    }
  }
}

TEST(GridGuard, CostsNoMoreThanTheBestWayOnTheGrid) {
  struct Price {
    CostKind kind;
    double alpha_per_m;
  };
  for (const Price price :
       {Price{CostKind::kUcb, 0.0}, Price{CostKind::kUcb, 5.0}, Price{CostKind::kEuclidean, 0.0}}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const PathCase c(seed, {60, 50, 40, 5}, price.kind, price.alpha_per_m);
      const Grid<double> oracle = lab::OracleCosts(c.cost, c.start_cell, 8);
      const PathResult result = Completed(c);
      for (std::size_t i = 0; i < c.goals.size(); ++i) {
        ASSERT_TRUE(result.paths[i].has_value());
        EXPECT_LE(result.paths[i]->cost, oracle[c.goals[i].cell] + kRounding);
      }
    }
  }
}

TEST(GridGuard, IsExactBeforeTheShortcut) {
  // With its budget spent the path is the one of the grid search itself.
  const PathCase c(7, {60, 50, 40, 5});
  const Grid<double> oracle = lab::OracleCosts(c.cost, c.start_cell, 8);
  PathResult result = NothingFound(c);
  result.effort.edges_evaluated = 1;
  CompleteOnGrid(c.Problem(1, 1), PathSource::kGridGuard, result);
  for (std::size_t i = 0; i < c.goals.size(); ++i) {
    ASSERT_TRUE(result.paths[i].has_value());
    EXPECT_NEAR(result.paths[i]->cost, oracle[c.goals[i].cell], kRounding);
  }
}

TEST(GridGuard, StartsWhereTheRobotStandsInItsCell) {
  PathCase c(8);
  c.start = {c.start.x_m + 0.03, c.start.y_m - 0.04};
  const PathResult result = Completed(c);
  for (const auto& path : result.paths) {
    ASSERT_TRUE(path.has_value());
    EXPECT_EQ(path->vertices.front(), c.start);
    EXPECT_TRUE(testing::StaysClear(c.information.penalty, path->vertices));
  }
}

TEST(GridGuard, LeavesPathsThatWereFoundAndDoesNothingIfNoneIsMissed) {
  const PathCase c(9);
  PathResult result = NothingFound(c);
  for (auto& path : result.paths) path = FoundPath{{c.start, {9.0, 9.0}}, 42.0, PathSource::kTree};
  CompleteOnGrid(c.Problem(), PathSource::kGridGuard, result);
  EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
  EXPECT_EQ(result.effort, PlanEffort{});
  for (const auto& path : result.paths) EXPECT_EQ(path->cost, 42.0);
}

TEST(GridGuard, GivesUpOnGoalsWithoutAWay) {
  PathCase c(10);
  c.goals[0].cell = {-1, -1};
  c.reachable[c.goals[1].cell] = 0;
  const PathResult result = Completed(c);
  EXPECT_EQ(result.end, PlanEnd::kQueueExhausted);
  EXPECT_FALSE(result.paths[0].has_value());
  EXPECT_FALSE(result.paths[1].has_value());
  EXPECT_TRUE(result.paths[2].has_value());
}

TEST(GridGuard, StopsWhenTold) {
  PathCase c(11, {200, 200, 60, 5});
  int polls = 0;
  c.stop = [&polls] { return ++polls > 0; };
  const PathResult result = Completed(c);
  EXPECT_EQ(result.end, PlanEnd::kStopped);
}

TEST(GridGuard, ReachesAGoalUnderTheRobot) {
  PathCase c(12, {1, 1, 0, 1});
  const PathResult result = Completed(c);
  ASSERT_TRUE(result.paths[0].has_value());
  EXPECT_EQ(result.paths[0]->cost, 0.0);
  EXPECT_EQ(result.paths[0]->vertices.size(), 1U);
}

}  // namespace grid_guard_test
}  // namespace plumescout
