// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/plan_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/small_plan_picture.h"

namespace plumescout::lab {
namespace plan_json_test {

TEST(PlanJson, HoldsEveryCandidateAndRejection) {
  const Plan plan = MakeSmallPlanPicture().plan;
  const auto json = nlohmann::json::parse(PlanToJson(plan, 3));
  EXPECT_EQ(json["chosen"], 1);
  EXPECT_EQ(json["effort"]["tree_edges"], 3);
  ASSERT_EQ(json["candidates"].size(), 2u);
  EXPECT_EQ(json["candidates"][0]["goal"]["kind"], "gas frontier");
  EXPECT_EQ(json["candidates"][0]["expected_information_nats"], 1.5);
  EXPECT_FALSE(json["candidates"][1].contains("expected_information_nats"));
  EXPECT_EQ(json["candidates"][1]["path_m"], (nlohmann::json{{2.0, 2.0}, {2.0, 5.0}}));
  ASSERT_EQ(json["rejected"].size(), 1u);
  EXPECT_EQ(json["rejected"][0]["reason"], "too small");
}

TEST(PlanJson, WhatIsNotFiniteIsNull) {
  Plan plan = MakeSmallPlanPicture().plan;
  plan.candidates[0].mean_ucb = std::nan("");
  const auto json = nlohmann::json::parse(PlanToJson(plan, 0));
  EXPECT_TRUE(json["candidates"][0]["mean_ucb"].is_null());
}

}  // namespace plan_json_test
}  // namespace plumescout::lab
