// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// ComposedStrategy when no frontier is left.
#include <gtest/gtest.h>

#include "core/plan/composed_strategy.h"
#include "tests/support/goal_case.h"
#include "tests/support/strategy_case.h"

namespace plumescout {
namespace composed_strategy_fallback_test {

using testing::Chosen;
using testing::For;
using testing::TryPlan;

const testing::GridArt kClosed = {"########",  //
                                  "#gggggg#",  //
                                  "#gSgggg#",  //
                                  "########"};

TEST(StrategyFallback, VisitsRandomPlacesWhenNoFrontierIsLeftAndThenIsComplete) {
  testing::GoalCase c(kClosed);
  c.AddGas(kClosed, 0.0F);  // measured everywhere, no gas
  PlanningOptions options = testing::XitGff();
  options.min_goal_distance_m = 0.1;
  absl::StatusOr<Plan> plan = TryPlan(c.belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->phase, MissionPhase::kFallback);
  EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kRandomFreeSpace);

  c.belief.robots["r"].fruitless_fallbacks = 2;
  plan = TryPlan(c.belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->phase, MissionPhase::kComplete);
  EXPECT_EQ(plan->end, PlanEnd::kMissionComplete);
  EXPECT_EQ(plan->chosen, -1);
}

TEST(StrategyFallback, VisitsUnobservedGasForReadingsAndNotInVain) {
  const testing::GridArt art = {"############",  //
                                "#Sgg.......#",  //
                                "#ggg.......#",  //
                                "############"};
  testing::GoalCase c(art);
  c.AddGas(art, 0.0F);
  c.belief.gas_counters.readings = 1;
  PlanningOptions options = testing::XitGff();
  options.min_goal_distance_m = 0.1;
  const absl::StatusOr<Plan> plan = TryPlan(c.belief, For("r"), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(Chosen(*plan).goal.kind, GoalKind::kInformation);
  EXPECT_EQ(plan->phase, MissionPhase::kGasProbing) << "no fallback, which would count";
}

}  // namespace composed_strategy_fallback_test
}  // namespace plumescout
