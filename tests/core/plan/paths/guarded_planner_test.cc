// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/guarded_planner.h"

#include <gtest/gtest.h>

#include "core/plan/paths/xit.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace guarded_planner_test {

using testing::PathCase;

PathResult Search(const PathCase& c, const PlanningOptions& options) {
  return GuardedPlanner(std::make_unique<const XitPlanner>(options), options)
      .FindPaths(c.Problem());
}

PlanningOptions FewSamples() {
  PlanningOptions options;
  options.sample_count = 15;
  return options;
}

TEST(GuardedPlanner, ReachesWhatTheTreeMisses) {
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PathCase c(seed, {60, 50, 40, 5});
    const PathResult tree = XitPlanner(FewSamples()).FindPaths(c.Problem());
    const PathResult guarded = Search(c, FewSamples());
    EXPECT_EQ(guarded.end, PlanEnd::kAllGoalsReached);
    int by_guard = 0;
    for (std::size_t i = 0; i < c.goals.size(); ++i) {
      ASSERT_TRUE(guarded.paths[i].has_value());
      EXPECT_EQ(guarded.paths[i]->source == PathSource::kGridGuard, !tree.paths[i].has_value());
      by_guard += tree.paths[i] ? 0 : 1;
    }
    EXPECT_EQ(guarded.effort.goals_by_guard, by_guard);
    missed += by_guard;
  }
  EXPECT_GT(missed, 0);
}

TEST(GuardedPlanner, AddsNothingIfToldSo) {
  PlanningOptions bare = FewSamples();
  bare.grid_guard = false;
  bare.straighten = false;
  const PathCase c(2, {60, 50, 40, 5});
  const PathResult tree = XitPlanner(bare).FindPaths(c.Problem());
  const PathResult result = Search(c, bare);
  EXPECT_EQ(result.paths, tree.paths);
  EXPECT_EQ(result.effort, tree.effort);
}

TEST(GuardedPlanner, StraightensTheTreesPaths) {
  const PathCase c(2);
  PlanningOptions bent;
  bent.straighten = false;
  const PathResult tree = Search(c, bent);
  const PathResult straight = Search(c, PlanningOptions{});
  double before = 0.0;
  double after = 0.0;
  for (std::size_t i = 0; i < c.goals.size(); ++i) {
    before += tree.paths[i]->cost;
    after += straight.paths[i]->cost;
  }
  EXPECT_LT(after, before);
}

}  // namespace guarded_planner_test
}  // namespace plumescout
