// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/planner_registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "tests/support/path_case.h"

namespace plumescout::lab {
namespace planner_registry_test {

TEST(PlannerRegistry, NamesEveryRowOnce) {
  std::set<std::string> names;
  const std::vector<RegisteredPlanner> planners = PlannerRegistry();
  for (const RegisteredPlanner& row : planners) {
    EXPECT_NE(row.planner, nullptr) << row.name;
    names.insert(row.name);
  }
  EXPECT_EQ(names.size(), planners.size());
  for (const char* name :
       {"xit_300_published", "mit_270", "xit_300", "xit_300_tree_only", "grid_exact", "anytime_xit",
        "rrt_1000", "rrt_star_1000", "informed_rrt_star_1000", "bit_star_1000", "prm_star_1000"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(PlannerRegistry, RunsEveryRowOnTheSameWork) {
  const testing::PathCase c(2);
  for (const RegisteredPlanner& row : PlannerRegistry()) {
    const bool is_quick = !row.is_rival || row.name.ends_with("_300");
    if (!is_quick) continue;
    const PathResult result = row.planner->FindPaths(c.Problem());
    ASSERT_EQ(result.paths.size(), c.goals.size()) << row.name;
    EXPECT_TRUE(std::any_of(result.paths.begin(), result.paths.end(), [](const auto& path) {
      return path.has_value();
    })) << row.name;
  }
}

}  // namespace planner_registry_test
}  // namespace plumescout::lab
