// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/mission_options.h"

#include <gtest/gtest.h>

#include "proto/convert/status.h"

namespace plumescout::server {
namespace {

TEST(MissionOptionsTest, NamedStrategySetsThePartsOfItsRow) {
  v1::MissionOptions proto;
  proto.mutable_planning()->set_strategy("xit_f");
  const auto options = ReadMissionOptions(proto, {}, "options");
  ASSERT_TRUE(options.ok()) << options.status();
  EXPECT_EQ(options->planning.goals, GoalPolicy::kOccupancyOnly);
}

TEST(MissionOptionsTest, FieldsThatAreSetOverrideTheRow) {
  v1::MissionOptions proto;
  proto.mutable_planning()->set_strategy("xit_f");
  proto.mutable_planning()->set_goal_policy(v1::GOAL_POLICY_OCCUPANCY_FIRST);
  EXPECT_EQ(ReadMissionOptions(proto, {}, "options")->planning.goals, GoalPolicy::kOccupancyFirst);
}

TEST(MissionOptionsTest, WithoutANameTheDefaultsStay) {
  MissionOptions defaults;
  defaults.planning.goals = GoalPolicy::kOccupancyFirst;
  defaults.gas.prior_precision = 7.0;
  const auto options = ReadMissionOptions({}, defaults, "options");
  EXPECT_EQ(options->planning.goals, GoalPolicy::kOccupancyFirst);
  EXPECT_EQ(options->gas.prior_precision, 7.0);
}

TEST(MissionOptionsTest, UnknownStrategyIsRefusedByItsField) {
  v1::MissionOptions proto;
  proto.mutable_planning()->set_strategy("teleport");
  const auto options = ReadMissionOptions(proto, {}, "options");
  EXPECT_EQ(FieldViolations(options.status()).at(0).field, "options.planning.strategy");
}

}  // namespace
}  // namespace plumescout::server
