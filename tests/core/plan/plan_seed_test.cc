// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/plan_seed.h"

#include <gtest/gtest.h>

#include <set>

namespace plumescout {
namespace plan_seed_test {

TEST(DerivedPlanSeed, DiffersForEveryMissionRobotAndPlan) {
  std::set<std::uint64_t> seeds;
  for (const std::uint64_t mission : {0, 1, 2}) {
    for (const char* robot : {"a", "b", "ab", "ba"}) {
      for (int plan = 0; plan < 50; ++plan) seeds.insert(DerivedPlanSeed(mission, robot, plan));
    }
  }
  EXPECT_EQ(seeds.size(), 3U * 4U * 50U);
  EXPECT_EQ(seeds.count(0), 0U);
}

TEST(DerivedPlanSeed, IsTheSameEverywhere) {
  // A change here would make recorded missions plan otherwise.
  EXPECT_EQ(DerivedPlanSeed(1, "r", 0), 2873858097215289398U);
}

}  // namespace plan_seed_test
}  // namespace plumescout
