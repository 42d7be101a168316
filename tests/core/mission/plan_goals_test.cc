// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/plan_goals.h"

#include "gtest/gtest.h"

namespace plumescout {
namespace plan_goals_test {

Goal At(double x_m, GoalKind kind = GoalKind::kInformation) {
  return {kind, {}, {x_m, 0.0}, {x_m, 0.0}, 0};
}

Plan To(const Goal& goal) {
  Plan plan;
  plan.candidates.resize(2);
  plan.candidates[1].goal = goal;
  plan.chosen = 1;
  plan.rejected = {{At(5.0), RejectionReason::kTooSmall, ""},
                   {At(6.0), RejectionReason::kTraffic, ""},
                   {At(7.0), RejectionReason::kTraffic, ""}};
  return plan;
}

TEST(PlanGoals, AnErrandIsClaimedHomeAndMakingWayAreNot) {
  EXPECT_EQ(GoalToClaim(To(At(1.0))), At(1.0));
  EXPECT_FALSE(GoalToClaim(To(At(1.0, GoalKind::kHome))).has_value());
  EXPECT_FALSE(GoalToClaim(To(At(1.0, GoalKind::kMakeWay))).has_value());
  EXPECT_EQ(ChosenGoal(To(At(1.0, GoalKind::kMakeWay))), At(1.0, GoalKind::kMakeWay));
  EXPECT_FALSE(ChosenGoal(Plan{}).has_value());
}

TEST(PlanGoals, WhoStaysOrMakesWayWantsTheFirstGoalThatOthersAreInTheWayOf) {
  Plan plan = To(At(1.0));
  EXPECT_FALSE(WantedGoal(plan).has_value()) << "it has something to do";
  EXPECT_EQ(WantedGoal(To(At(1.0, GoalKind::kMakeWay))), At(6.0));
  plan.chosen = -1;
  EXPECT_EQ(WantedGoal(plan), At(6.0));
  plan.rejected.resize(1);
  EXPECT_FALSE(WantedGoal(plan).has_value());
}

}  // namespace plan_goals_test
}  // namespace plumescout
