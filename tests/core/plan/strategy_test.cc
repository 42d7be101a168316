// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/strategy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumescout {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(StrategyTable, NamesTheRowsOfThePapersAndOurs) {
  EXPECT_THAT(StrategyNames(),
              ElementsAre("xit_gff", "xit_fgf", "xit_f", "mit", "rrt_star_frontier", "plumescout"));
}

TEST(StrategyTable, DefaultsAreThePartsOfTheRowThatTheyName) {
  PlanningOptions options;
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  const PlanningOptions defaults;
  EXPECT_EQ(options.goals, defaults.goals);
  EXPECT_EQ(options.paths, defaults.paths);
  EXPECT_EQ(options.cost, defaults.cost);
  EXPECT_EQ(options.selection_cost, defaults.selection_cost);
  EXPECT_EQ(options.selection, defaults.selection);
  EXPECT_EQ(options.straighten, defaults.straighten);
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

TEST(StrategyTable, MakesMitASearchByDistanceAmongSamplesOfTheField) {
  PlanningOptions options;
  options.strategy = "mit";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.cost, CostKind::kEuclidean);
  EXPECT_EQ(options.selection, SelectionRule::kMeanUcb);
  EXPECT_EQ(options.samples, 270);  // [MIT] section IV, as the rest
  EXPECT_EQ(options.nearest_samples, 3);
  EXPECT_EQ(options.beta, 1.0);
  EXPECT_EQ(options.uniform_share, 0.0);
  EXPECT_EQ(options.sampling, SamplingKind::kIid);
  EXPECT_FALSE(options.goal_vertices);
  EXPECT_FALSE(options.straighten);
  EXPECT_TRUE(MakeStrategy(options).ok());
}

TEST(StrategyTable, MakesOursGoForInformationPerSecondWhereverItIs) {
  PlanningOptions options;
  options.strategy = "mit";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  options.strategy = "plumescout";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.goals, GoalPolicy::kEverything);
  EXPECT_EQ(options.paths, PathKind::kXit);
  EXPECT_EQ(options.cost, CostKind::kUcb);
  EXPECT_EQ(options.selection_cost, CostKind::kUcb);
  EXPECT_EQ(options.selection, SelectionRule::kInformationRate);
  EXPECT_TRUE(options.straighten);
  EXPECT_TRUE(MakeStrategy(options).ok());
}

TEST(StrategyTable, NeedsSomebodyToMakeTheBaselines) {
  PlanningOptions options;
  options.strategy = "rrt_star_frontier";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.paths, PathKind::kRrtStar);
  EXPECT_EQ(MakeStrategy(options).status().code(), absl::StatusCode::kInvalidArgument);
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
