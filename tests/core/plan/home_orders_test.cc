// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/home_orders.h"

#include <gtest/gtest.h>

#include <memory>

namespace plumescout {
namespace home_orders_test {

Belief BeliefOf(const RobotRecord& record) {
  MissionOptions options;
  options.return_home_below_battery_share = 0.2;
  Belief belief;
  belief.options = std::make_shared<const MissionOptions>(options);
  belief.robots["r1"] = record;
  return belief;
}

PlanRequest RequestOf(const RobotId& robot) {
  PlanRequest request;
  request.robot = robot;
  return request;
}

TEST(HomeOrdersTest, WhoIsNotSentHomeGetsWhatItAsksFor) {
  const Belief belief = BeliefOf({});
  EXPECT_FALSE(WithOrders(belief, RequestOf("r1")).go_home);
  EXPECT_FALSE(WithOrders(belief, RequestOf("nobody")).go_home);
  EXPECT_EQ(WhySentHome(belief, "r1"), "");
  EXPECT_EQ(WhySentHome(belief, "nobody"), "");
}

TEST(HomeOrdersTest, AnOrderSendsHomeAndIsExplained) {
  RobotRecord record;
  record.state.ordered_home = true;
  EXPECT_TRUE(WithOrders(BeliefOf(record), RequestOf("r1")).go_home);
  EXPECT_EQ(WhySentHome(BeliefOf(record), "r1"), " An operator ordered the robot home.");
}

TEST(HomeOrdersTest, ALowBatterySendsHomeAndIsExplained) {
  RobotRecord record;
  record.battery_low = true;
  record.state.battery_share = 0.15;
  EXPECT_TRUE(WithOrders(BeliefOf(record), RequestOf("r1")).go_home);
  EXPECT_EQ(WhySentHome(BeliefOf(record), "r1"),
            " Its battery, at 15 %, has been below 20 %: it goes home.");
}

TEST(WhyOver, SaysWhatIsReachedOrThatItIsTooLate) {
  Belief belief = BeliefOf({});
  EXPECT_EQ(WhyOver(belief), "");
  MissionOptions options;
  options.objective = {
      .kind = ObjectiveKind::kConfirmClean, .threshold_ppm = 10.0, .deadline_s = 600.0};
  belief.options = std::make_shared<const MissionOptions>(options);
  belief.objective = ObjectiveStatus{.state = ObjectiveState::kPursued};
  belief.deadline_ns = 100;
  EXPECT_EQ(WhyOver(belief), "");
  belief.sample_time_ns = 100;
  EXPECT_EQ(WhyOver(belief), " The deadline, 600 s from the first observation, has passed.");
  belief.objective->state = ObjectiveState::kMet;
  belief.objective->confidence = 0.96;
  EXPECT_EQ(WhyOver(belief),
            " The objective is met: clean: nowhere more than 10 ppm, with a confidence of 96 %.");
}

}  // namespace home_orders_test
}  // namespace plumescout
