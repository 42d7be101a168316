// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/missions/latest_plans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/str_cat.h"

namespace plumescout::server {
namespace latest_plans_test {

using ::testing::ElementsAre;

Plan PlanOf(const RobotId& robot, PlanId id) {
  Plan plan;
  plan.robot = robot;
  plan.id = id;
  return plan;
}

std::vector<std::string> Names(const LatestPlans& plans) {
  std::vector<std::string> names;
  for (const LatestPlans::PlanPtr& plan : plans.All()) {
    names.push_back(absl::StrCat(plan->robot, " ", plan->id));
  }
  return names;
}

TEST(LatestPlans, EachRobotHasItsLatest) {
  LatestPlans plans;
  EXPECT_TRUE(plans.All().empty());
  plans.Note(PlanOf("r2", 1));
  plans.Note(PlanOf("r1", 2));
  plans.Note(PlanOf("r2", 3));
  EXPECT_THAT(Names(plans), ElementsAre("r1 2", "r2 3"));
}

TEST(LatestPlans, RemovedRobotsAreForgotten) {
  LatestPlans plans;
  plans.Note(PlanOf("r1", 1));
  plans.Note(PlanOf("r2", 2));
  plans.Forget("r1");
  plans.Forget("unknown");
  EXPECT_THAT(Names(plans), ElementsAre("r2 2"));
}

TEST(LatestPlans, OldestAreForgottenBeyondTheLimit) {
  LatestPlans plans;
  PlanId id = 0;
  plans.Note(PlanOf("first", ++id));
  plans.Note(PlanOf("second", ++id));
  plans.Note(PlanOf("first", ++id));
  for (std::size_t i = 2; i <= LatestPlans::kMaxRobots; ++i) {
    plans.Note(PlanOf(absl::StrCat("r", i), ++id));
  }
  const std::vector<std::string> names = Names(plans);
  EXPECT_EQ(names.size(), LatestPlans::kMaxRobots);
  EXPECT_EQ(names.front(), "first 3");
  EXPECT_THAT(names, ::testing::Not(::testing::Contains("second 2")));
}

}  // namespace latest_plans_test
}  // namespace plumescout::server
