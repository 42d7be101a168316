// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/strategy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumescout {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(StrategyTable, NamesTheRowsOfThePaper) {
  EXPECT_THAT(StrategyNames(), ElementsAre("xit_gff", "xit_fgf", "xit_f"));
}

TEST(StrategyTable, SetsThePartsOfARow) {
  PlanningOptions options;
  options.cost = CostKind::kEuclidean;
  options.selection = SelectionRule::kMeanUcb;
  options.samples = 77;
  options.strategy = "xit_fgf";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.goals, GoalPolicy::kOccupancyFirst);
  EXPECT_EQ(options.cost, CostKind::kUcb);
  EXPECT_EQ(options.selection, SelectionRule::kLeastCost);
  EXPECT_EQ(options.samples, 77) << "no part of the row";
  options.strategy = "xit_f";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.goals, GoalPolicy::kOccupancyOnly);
}

TEST(StrategyTable, RefusesUnknownNamesAndBadOptions) {
  PlanningOptions options;
  options.strategy = "teleport";
  EXPECT_EQ(ApplyStrategyRow(options).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(MakeStrategy(options).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(MakeStrategy(options).status().message()), HasSubstr("xit_gff"));
  options = {};
  options.samples = 0;
  EXPECT_EQ(MakeStrategy(options).status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace plumescout
