// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/region_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/plan/paths/path_planners.h"
#include "ompl_planners/ompl_planner.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace region_tree_test {

using testing::PathCase;

constexpr double kRadius_m = 0.3;
constexpr double kStep_m = 0.6;

class RegionTree : public ::testing::TestWithParam<PathKind> {
 protected:
  PathResult Grow(const PathProblem& problem, int max_samples = 10'000) const {
    return GrowRegionTree({GetParam(), kStep_m, kRadius_m, max_samples}, problem);
  }
};

TEST_P(RegionTree, LeadsIntoTheDiscOfEveryGoalWithoutHittingAnything) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const PathCase c(seed, {}, CostKind::kEuclidean);
    const PathResult result = Grow(c.Problem(seed));
    EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
    ASSERT_EQ(result.paths.size(), c.goals.size());
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      ASSERT_TRUE(result.paths[i]) << "seed " << seed << ", goal " << i;
      const std::vector<Point2>& path = result.paths[i]->vertices;
      EXPECT_EQ(path.front(), c.start);
      EXPECT_LE(Distance_m(path.back(), c.goals[i].position), kRadius_m);
      EXPECT_TRUE(testing::StaysClear(c.information.penalty, path));
      EXPECT_DOUBLE_EQ(result.paths[i]->cost, PathCost(c.cost, path));
    }
  }
}

TEST_P(RegionTree, HasNoEdgeLongerThanItsStep) {
  const PathCase c(3, {}, CostKind::kEuclidean);
  for (const auto& path : Grow(c.Problem()).paths) {
    ASSERT_TRUE(path);
    for (std::size_t i = 1; i < path->vertices.size(); ++i) {
      EXPECT_LE(Distance_m(path->vertices[i - 1], path->vertices[i]), kStep_m * (1.0 + 1e-9));
    }
  }
}

TEST_P(RegionTree, EndsWhenEveryDiscIsReached) {
  const PathCase c(2, {}, CostKind::kEuclidean);
  const PathResult result = Grow(c.Problem());
  const PathResult unbounded = Grow(c.Problem(), std::numeric_limits<int>::max());
  EXPECT_LT(result.effort.samples, 10'000);
  EXPECT_EQ(unbounded.effort, result.effort);
  EXPECT_EQ(unbounded.paths, result.paths);
}

TEST_P(RegionTree, GivesUpAfterItsSamples) {
  const PathCase c(2, {}, CostKind::kEuclidean);
  const int needed = Grow(c.Problem()).effort.samples;
  ASSERT_GT(needed, 3);
  const PathResult result = Grow(c.Problem(), needed / 3);
  EXPECT_LE(result.effort.samples, needed / 3);
  EXPECT_EQ(result.end, PlanEnd::kQueueExhausted);
}

TEST_P(RegionTree, RepeatsItselfByteForByteAndDrawsOtherwiseForAnotherSeed) {
  const PathCase c(4, {}, CostKind::kEuclidean);
  const PathResult once = Grow(c.Problem(1));
  EXPECT_NE(Grow(c.Problem(2)).paths, once.paths);
  const PathResult again = Grow(c.Problem(1));
  EXPECT_EQ(again.paths, once.paths);
  EXPECT_EQ(again.effort, once.effort);
}

TEST_P(RegionTree, ThePlannerIsTheSearch) {
  const PathCase c(4, {}, CostKind::kEuclidean);
  const auto planner = MakeRegionTreePlanner({GetParam(), kStep_m, kRadius_m, 10'000});
  EXPECT_EQ(planner->FindPaths(c.Problem()).paths, Grow(c.Problem()).paths);
}

TEST_P(RegionTree, AGoalAroundTheStartIsReachedAtOnce) {
  PathCase c(2, {60, 50, 25, 1}, CostKind::kEuclidean);
  c.goals = {testing::GoalAt(c.start_cell, c.open.geometry())};
  const PathResult result = Grow(c.Problem());
  ASSERT_TRUE(result.paths[0]);
  EXPECT_EQ(result.effort.samples, 0);
  EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
}

TEST_P(RegionTree, FromABlockedStartOrWithoutGoalsNothingIsSearched) {
  PathCase c(2, {}, CostKind::kEuclidean);
  c.start = {NAN, NAN};
  const PathResult blocked = Grow(c.Problem());
  EXPECT_EQ(blocked.end, PlanEnd::kQueueExhausted);
  EXPECT_EQ(blocked.paths.size(), c.goals.size());
  EXPECT_EQ(blocked.effort, PlanEffort{});
  c.goals.clear();
  EXPECT_EQ(Grow(c.Problem()).end, PlanEnd::kAllGoalsReached);
}

TEST_P(RegionTree, AGoalFarOutsideIsLeftAndTheOthersAreServed) {
  PathCase c(2, {60, 50, 25, 2}, CostKind::kEuclidean);
  c.goals[0] = testing::GoalAt({-5, 1'000'000}, c.open.geometry());
  const PathResult result = Grow(c.Problem(), 2000);
  EXPECT_FALSE(result.paths[0]);
  EXPECT_TRUE(result.paths[1]);
  EXPECT_EQ(result.end, PlanEnd::kQueueExhausted);
}

TEST_P(RegionTree, EndsAtTheStopFunctionsWord) {
  PathCase c(2, {}, CostKind::kEuclidean);
  int polls = 0;
  c.stop = [&] { return ++polls > 3; };
  EXPECT_EQ(Grow(c.Problem()).end, PlanEnd::kStopped);
}

INSTANTIATE_TEST_SUITE_P(Kinds, RegionTree, ::testing::Values(PathKind::kRrt, PathKind::kRrtStar),
                         [](const auto& info) { return std::string(PathKindName(info.param)); });

}  // namespace region_tree_test
}  // namespace plumescout
