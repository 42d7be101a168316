// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/anytime_xit.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "lab/worlds/grid_oracle.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace anytime_xit_test {

using testing::PathCase;

constexpr double kInf = std::numeric_limits<double>::infinity();

double SumOf(const PathResult& result) {
  double sum = 0.0;
  for (const auto& path : result.paths) sum += path ? path->cost : kInf;
  return sum;
}

TEST(AnytimeXit, NeverRaisesAPrice) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const PathCase c(seed);
    std::vector<PathResult> told;
    const PathListener listener = [&told](const PathResult& result) { told.push_back(result); };
    PathProblem problem = c.Problem(seed);
    problem.improved = &listener;
    const PathResult last = AnytimeXitPlanner({}).FindPaths(problem);
    ASSERT_FALSE(told.empty());
    for (std::size_t k = 1; k < told.size(); ++k) {
      EXPECT_LT(SumOf(told[k]), SumOf(told[k - 1]));
      for (std::size_t i = 0; i < c.goals.size(); ++i) {
        ASSERT_TRUE(told[k].paths[i].has_value());
        EXPECT_LE(told[k].paths[i]->cost, told[k - 1].paths[i]->cost);
      }
    }
    EXPECT_EQ(last.paths, told.back().paths);
    EXPECT_GE(last.effort.batches, static_cast<int>(told.size()));
  }
}

TEST(AnytimeXit, EndsNearTheBestStraightLines) {
  double found = 0.0;
  double best = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const PathCase c(seed);
    const Grid<double> oracle = lab::OracleCosts(c.cost, c.start_cell, 32);
    const PathResult result = AnytimeXitPlanner({}).FindPaths(c.Problem(seed));
    EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
    found += SumOf(result);
    for (const Goal& goal : c.goals) best += oracle[goal.cell];
  }
  EXPECT_LT(found, 1.01 * best);
}

TEST(AnytimeXit, KeepsWhatItHasWhenStopped) {
  PathCase c(4);
  bool told = false;
  const PathListener listener = [&told](const PathResult&) { told = true; };
  c.stop = [&told] { return told; };  // as soon as there is something
  PathProblem problem = c.Problem();
  problem.improved = &listener;
  const PathResult result = AnytimeXitPlanner({}).FindPaths(problem);
  EXPECT_EQ(result.effort.batches, 1);
  EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
}

TEST(AnytimeXit, SaysThatItWasStoppedBeforeItHadAnything) {
  PathCase c(4);
  c.stop = [] { return true; };
  const PathResult result = AnytimeXitPlanner({}).FindPaths(c.Problem());
  EXPECT_EQ(result.end, PlanEnd::kStopped);
}

TEST(AnytimeXit, IsRepeatableFromItsSeedAndBudget) {
  const PathCase c(6);
  const PathResult first = AnytimeXitPlanner({}).FindPaths(c.Problem(9, 4000));
  EXPECT_EQ(first.paths, AnytimeXitPlanner({}).FindPaths(c.Problem(9, 4000)).paths);
  EXPECT_LT(first.effort.edges_evaluated, 5000);  // a path's last shortcut may go beyond
}

TEST(AnytimeXit, EndsWhereAGoalCannotBeReached) {
  PathCase c(6);
  c.reachable[c.goals.front().cell] = 0;
  c.information.penalty[c.goals.front().cell] = std::numeric_limits<float>::infinity();
  const PathResult result = AnytimeXitPlanner({}).FindPaths(c.Problem());
  EXPECT_EQ(result.end, PlanEnd::kQueueExhausted);
  EXPECT_FALSE(result.paths.front().has_value());
}

}  // namespace anytime_xit_test
}  // namespace plumescout
