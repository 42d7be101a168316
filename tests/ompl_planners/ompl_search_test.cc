// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/ompl_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/plan/paths/path_planners.h"
#include "lab/worlds/grid_oracle.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace ompl_search_test {

using testing::PathCase;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr int kManySamples = 300;

class OmplSearch : public ::testing::TestWithParam<PathKind> {
 protected:
  PathResult Search(const PathProblem& problem, int samples = kManySamples) const {
    return SearchWithOmpl(GetParam(), samples, problem);
  }
  bool IsRoadmap() const { return GetParam() == PathKind::kPrmStar; }
};

int Reached(const PathResult& result) {
  int reached = 0;
  for (const auto& path : result.paths) reached += path ? 1 : 0;
  return reached;
}

// Of the paths that both have: the sum of the costs.
std::pair<double, double> CostsOfBoth(const PathResult& a, const PathResult& b) {
  std::pair<double, double> sums = {0.0, 0.0};
  for (std::size_t i = 0; i < a.paths.size(); ++i) {
    if (!a.paths[i] || !b.paths[i]) continue;
    sums.first += a.paths[i]->cost;
    sums.second += b.paths[i]->cost;
  }
  return sums;
}

TEST_P(OmplSearch, FindsPathsFromTheStartToTheGoalCellsThatHitNothing) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const PathCase c(seed);
    const PathResult result = Search(c.Problem(seed));
    ASSERT_EQ(result.paths.size(), c.goals.size());
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      if (!result.paths[i]) continue;
      ++found;
      const FoundPath& path = *result.paths[i];
      EXPECT_EQ(path.vertices.front(), c.start);
      EXPECT_EQ(path.vertices.back(), c.goals[i].position);
      EXPECT_TRUE(testing::StaysClear(c.information.penalty, path.vertices)) << "seed " << seed;
      EXPECT_EQ(path.cost, PathCost(c.cost, path.vertices));
      EXPECT_TRUE(std::isfinite(path.cost));
      EXPECT_EQ(path.source, PathSource::kTree);
    }
  }
  EXPECT_GE(found, 20);  // of 24; narrow passages may stay shut to random trees
}

TEST_P(OmplSearch, IsNowhereBelowTheBestGridPathByMoreThanTheGridMayLose) {
  // Straight lines at any angle beat 32 directions by less than 1.4 % in length; the field varies
  // slowly against a cell.
  constexpr double kGridLoss = 0.03;
  const PathCase c(2);
  const Grid<double> best = lab::OracleCosts(c.cost, c.start_cell, 32);
  const PathResult result = Search(c.Problem());
  for (std::size_t i = 0; i < c.goals.size(); ++i) {
    if (!result.paths[i]) continue;
    EXPECT_GT(result.paths[i]->cost, (1.0 - kGridLoss) * best[c.goals[i].cell]);
  }
}

TEST_P(OmplSearch, RepeatsItselfByteForByteAfterOtherSearches) {
  for (const double alpha_per_m : {0.0, 2.0}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const PathCase c(seed, {}, CostKind::kUcb, alpha_per_m);
      const PathResult once = Search(c.Problem(seed), 150);
      Search(c.Problem(seed + 100), 70);
      const PathResult again = Search(c.Problem(seed), 150);
      EXPECT_EQ(once.paths, again.paths) << "seed " << seed;
      EXPECT_EQ(once.effort, again.effort) << "seed " << seed;
      EXPECT_EQ(once.end, again.end);
    }
  }
}

TEST_P(OmplSearch, DrawsOtherwiseForAnotherSeed) {
  const PathCase c(2);
  EXPECT_NE(Search(c.Problem(1)).paths, Search(c.Problem(2)).paths);
}

TEST_P(OmplSearch, CountsItsEffort) {
  const PathCase c(2);
  const PathResult result = Search(c.Problem());
  const int searches = IsRoadmap() ? 1 : static_cast<int>(c.goals.size());
  constexpr int kBatch = 100;  // of BIT*, the one too many
  EXPECT_GT(result.effort.samples, 0);
  EXPECT_LE(result.effort.samples, searches * (kManySamples + kBatch));
  EXPECT_GE(result.effort.vertices, static_cast<int>(c.goals.size()) + 1);
  EXPECT_GT(result.effort.edges_evaluated, 0);
  EXPECT_EQ(result.effort.goals_by_guard, 0);
}

TEST_P(OmplSearch, KeepsTheBudgetOfEdgeEvaluations) {
  const PathCase c(2);
  const int unbounded = Search(c.Problem()).effort.edges_evaluated;
  for (const int budget : {1, 7, 100, unbounded / 2}) {
    const PathResult result = Search(c.Problem(1, budget));
    EXPECT_LE(result.effort.edges_evaluated, budget);
    EXPECT_EQ(result.end, PlanEnd::kStopped) << "budget " << budget;
    for (const auto& path : result.paths) {
      if (path) {
        EXPECT_TRUE(testing::StaysClear(c.information.penalty, path->vertices));
      }
    }
  }
  EXPECT_EQ(Search(c.Problem(1, 1000 * unbounded)).paths, Search(c.Problem()).paths);
}

TEST_P(OmplSearch, EndsAtTheStopFunctionsWord) {
  PathCase c(2);
  constexpr int kHuge = 100'000'000;  // would take hours
  for (const int allowed : {0, 1, 50}) {
    int polls = 0;
    c.stop = [&] { return ++polls > allowed; };
    const PathResult result = Search(c.Problem(), kHuge);
    EXPECT_EQ(result.end, PlanEnd::kStopped);
    EXPECT_EQ(polls, allowed + 1);  // not asked again
    EXPECT_EQ(result.paths.size(), c.goals.size());
  }
}

TEST_P(OmplSearch, OfNoSamplesDoesNoHarm) {
  const PathCase c(2);
  const PathResult result = Search(c.Problem(), 0);
  EXPECT_EQ(result.paths.size(), c.goals.size());
}

TEST_P(OmplSearch, OfNoGoalsHasReachedThemAll) {
  PathCase c(2);
  c.goals.clear();
  const PathResult result = Search(c.Problem());
  EXPECT_TRUE(result.paths.empty());
  EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
}

TEST_P(OmplSearch, FromABlockedStartFindsNothing) {
  PathCase c(2);
  c.reachable[c.start_cell] = 0;
  for (const Point2 start : {c.start, Point2{1e9, -1e9}, Point2{kInf, 0.0}, Point2{NAN, NAN}}) {
    c.start = start;
    const PathResult result = Search(c.Problem());
    EXPECT_EQ(Reached(result), 0);
    EXPECT_EQ(result.paths.size(), c.goals.size());
    EXPECT_EQ(result.end, PlanEnd::kQueueExhausted);
    EXPECT_EQ(result.effort, PlanEffort{});
  }
}

TEST_P(OmplSearch, LeavesGoalsOutOfReachAndServesTheOthers) {
  PathCase c(2);
  const auto blocked = std::find(c.reachable.values().begin(), c.reachable.values().end(), 0);
  const auto index = static_cast<std::size_t>(blocked - c.reachable.values().begin());
  ASSERT_LT(index, c.reachable.size());
  const GridGeometry& geometry = c.reachable.geometry();
  c.goals[1] = testing::GoalAt(geometry.CellAtIndex(index), geometry);
  c.goals[2] = testing::GoalAt({-5, 1'000'000}, geometry);
  const PathResult result = Search(c.Problem());
  EXPECT_TRUE(result.paths[0]);
  EXPECT_FALSE(result.paths[1]);
  EXPECT_FALSE(result.paths[2]);
  EXPECT_TRUE(result.paths[3]);
  EXPECT_EQ(result.end, PlanEnd::kQueueExhausted);
}

TEST_P(OmplSearch, ReachesGoalsInTheStartsOwnCell) {
  PathCase c(2, {60, 50, 25, 2});
  c.goals[0] = testing::GoalAt(c.start_cell, c.open.geometry());
  const PathResult at_the_centre = Search(c.Problem());
  ASSERT_TRUE(at_the_centre.paths[0]);
  EXPECT_EQ(at_the_centre.paths[0]->cost, 0.0);
  EXPECT_EQ(at_the_centre.paths[0]->vertices.front(), c.start);
  EXPECT_EQ(at_the_centre.paths[0]->vertices.back(), c.start);
  c.start.x_m += 0.03;
  const PathResult beside_it = Search(c.Problem());
  ASSERT_TRUE(beside_it.paths[0]);
  EXPECT_EQ(beside_it.paths[0]->vertices.front(), c.start);
  EXPECT_EQ(beside_it.paths[0]->vertices.back(), c.goals[0].position);
}

TEST_P(OmplSearch, CopesWithASingleFreeCell) {
  PathCase c(1, {1, 1, 0, 3});
  c.start.y_m -= 0.04;
  const PathResult result = Search(c.Problem());
  EXPECT_EQ(Reached(result), 3);
}

TEST_P(OmplSearch, CopesWithASingleCorridorOfCells) {
  const PathCase c(1, {40, 1, 0, 3});
  const PathResult result = Search(c.Problem());
  EXPECT_EQ(Reached(result), 3);
}

TEST_P(OmplSearch, SurvivesRandomWorldsOfAllShapes) {
  Rng rng(99);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const int width = 1 + static_cast<int>(rng.Below(40));
    const int height = 1 + static_cast<int>(rng.Below(40));
    const auto kind = rng.Below(2) == 0 ? CostKind::kUcb : CostKind::kEuclidean;
    const double alpha_per_m = rng.Below(2) == 0 ? 0.0 : rng.Uniform(0.0, 100.0);
    const int obstacles = std::min(width, height) / 4;
    const PathCase c(seed, {width, height, obstacles, 2}, kind, alpha_per_m);
    const auto budget = rng.Below(3) == 0 ? 1 + rng.Below(3000) : 0;
    const PathResult result = Search(c.Problem(seed, static_cast<std::int64_t>(budget)),
                                     static_cast<int>(rng.Below(150)));
    for (const auto& path : result.paths) {
      if (path) {
        EXPECT_TRUE(std::isfinite(path->cost));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, OmplSearch,
                         ::testing::Values(PathKind::kRrt, PathKind::kRrtStar,
                                           PathKind::kInformedRrtStar, PathKind::kBitStar,
                                           PathKind::kPrmStar),
                         [](const auto& info) { return std::string(PathKindName(info.param)); });

// RRT ends at its first path, however many samples it has.
class OmplSearchOfTheBest : public OmplSearch {};

TEST_P(OmplSearchOfTheBest, IsCheaperWithMoreSamples) {
  double few_cost = 0.0;
  double many_cost = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const PathCase c(seed, {60, 50, 25, 2});
    const auto [few, many] = CostsOfBoth(Search(c.Problem(), 150), Search(c.Problem(), 600));
    few_cost += few;
    many_cost += many;
  }
  EXPECT_GT(few_cost, 0.0);
  EXPECT_LT(many_cost, 0.99 * few_cost);
}

TEST_P(OmplSearchOfTheBest, ComesNearTheBestGridPath) {
  const PathCase c(2, {30, 30, 6, 2});
  const Grid<double> best = lab::OracleCosts(c.cost, c.start_cell, 32);
  const PathResult result = Search(c.Problem(), 1000);
  ASSERT_EQ(Reached(result), 2);
  double cost = 0.0;
  double grid_cost = 0.0;
  for (std::size_t i = 0; i < c.goals.size(); ++i) {
    cost += result.paths[i]->cost;
    grid_cost += best[c.goals[i].cell];
  }
  EXPECT_LT(cost, 1.05 * grid_cost);
}

INSTANTIATE_TEST_SUITE_P(Kinds, OmplSearchOfTheBest,
                         ::testing::Values(PathKind::kRrtStar, PathKind::kInformedRrtStar,
                                           PathKind::kBitStar, PathKind::kPrmStar),
                         [](const auto& info) { return std::string(PathKindName(info.param)); });

// A tree keeps what it has: the path only improves while the same search goes on.
TEST(OmplRrtStar, IsNoDearerAfterMoreOfTheSameIterations) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const PathCase c(seed, {60, 50, 25, 1});
    double last_cost = kInf;
    for (const int samples : {50, 100, 200, 400}) {
      const PathResult result = SearchWithOmpl(PathKind::kRrtStar, samples, c.Problem());
      if (!result.paths[0]) continue;
      EXPECT_LE(result.paths[0]->cost, last_cost + 1e-9);
      last_cost = result.paths[0]->cost;
    }
    EXPECT_LT(last_cost, kInf);
  }
}

}  // namespace ompl_search_test
}  // namespace plumescout
