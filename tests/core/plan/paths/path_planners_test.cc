// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/path_planners.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/path_case.h"

namespace plumescout {
namespace path_planners_test {

using testing::PathCase;

constexpr PathKind kKinds[] = {
    PathKind::kXit,     PathKind::kAnytimeXit,      PathKind::kGridExact, PathKind::kRrt,
    PathKind::kRrtStar, PathKind::kInformedRrtStar, PathKind::kBitStar,   PathKind::kPrmStar};

// Finds nothing, so that the guard has all to do.
class NoPlanner : public PathPlanner {
 public:
  PathResult FindPaths(const PathProblem& problem) const override {
    PathResult result;
    result.paths.resize(problem.goals.size());
    return result;
  }
};

TEST(MakePathPlanner, MakesOursThatReachTheirGoals) {
  const PathCase c(1);
  for (const PathKind kind : {PathKind::kXit, PathKind::kAnytimeXit, PathKind::kGridExact}) {
    PlanningOptions options;
    options.paths = kind;
    const auto planner = MakePathPlanner(options, nullptr);
    ASSERT_TRUE(planner.ok()) << planner.status();
    EXPECT_EQ((*planner)->FindPaths(c.Problem()).end, PlanEnd::kAllGoalsReached);
  }
}

TEST(MakePathPlanner, GuardsTheBaselinesThatOthersMake) {
  const PathCase c(1);
  PlanningOptions options;
  options.paths = PathKind::kPrmStar;
  const auto planner = MakePathPlanner(
      options, [](const PlanningOptions&) { return std::make_unique<const NoPlanner>(); });
  ASSERT_TRUE(planner.ok()) << planner.status();
  const PathResult result = (*planner)->FindPaths(c.Problem());
  EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached);
  EXPECT_EQ(result.effort.goals_by_guard, static_cast<int>(c.goals.size()));
}

TEST(MakePathPlanner, RefusesWhatNobodyMakes) {
  PlanningOptions options;
  options.paths = PathKind::kRrtStar;
  const auto planner = MakePathPlanner(options, nullptr);
  EXPECT_TRUE(absl::IsInvalidArgument(planner.status()));
  EXPECT_NE(planner.status().message().find("planning.paths = rrt_star"), std::string::npos);
}

TEST(PathKindName, IsDifferentForEachKind) {
  std::set<std::string> names;
  for (const PathKind kind : kKinds) names.emplace(PathKindName(kind));
  EXPECT_EQ(names.size(), std::size(kKinds));
  EXPECT_FALSE(names.contains(""));
}

}  // namespace path_planners_test
}  // namespace plumescout
