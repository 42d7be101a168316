// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/strategy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumescout {
namespace strategy_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(StrategyTable, NamesTheRowsOfThePapersAndOurs) {
  EXPECT_THAT(StrategyNames(),
              ElementsAre("xit_gff", "xit_fgf", "xit_f", "mit", "rrt_star_frontier", "plumescout",
                          "ipp_reward", "lhr", "random_sampling", "sweep"));
}

TEST(StrategyTable, TellsThoseThatStopAtSites) {
  for (const char* name : {"ipp_reward", "lhr", "random_sampling", "sweep"}) {
    EXPECT_TRUE(StopsAtSites(name)) << name;
  }
  for (const char* name : {"plumescout", "mit", "none"}) EXPECT_FALSE(StopsAtSites(name)) << name;
}

TEST(StrategyTable, DefaultsAreThePartsOfTheRowThatTheyName) {
  PlanningOptions options;
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  const PlanningOptions defaults;
  EXPECT_EQ(options.goal_policy, defaults.goal_policy);
  EXPECT_EQ(options.paths, defaults.paths);
  EXPECT_EQ(options.cost, defaults.cost);
  EXPECT_EQ(options.selection_cost, defaults.selection_cost);
  EXPECT_EQ(options.selection_rule, defaults.selection_rule);
  EXPECT_EQ(options.straighten, defaults.straighten);
}

TEST(StrategyTable, SetsThePartsOfARow) {
  PlanningOptions options;
  options.cost = CostKind::kEuclidean;
  options.selection_rule = SelectionRule::kMeanUcb;
  options.sample_count = 77;
  options.strategy = "xit_fgf";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.goal_policy, GoalPolicy::kOccupancyFirst);
  EXPECT_EQ(options.cost, CostKind::kUcb);
  EXPECT_EQ(options.selection_rule, SelectionRule::kLeastCost);
  EXPECT_EQ(options.sample_count, 77) << "no part of the row";
  options.strategy = "xit_f";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.goal_policy, GoalPolicy::kOccupancyOnly);
}

TEST(StrategyTable, MakesMitASearchByDistanceAmongSamplesOfTheField) {
  PlanningOptions options;
  options.strategy = "mit";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.cost, CostKind::kEuclidean);
  EXPECT_EQ(options.selection_rule, SelectionRule::kMeanUcb);
  EXPECT_EQ(options.sample_count, 270);  // [MIT] section IV, as the rest
  EXPECT_EQ(options.nearest_sample_count, 3);
  EXPECT_EQ(options.beta, 1.0);
  EXPECT_EQ(options.uniform_share, 0.0);
  EXPECT_EQ(options.sampling, SamplingKind::kIid);
  EXPECT_FALSE(options.goal_vertices);
  EXPECT_FALSE(options.straighten);
  EXPECT_EQ(options.max_connection_radius_m, PlanningOptions().max_connection_radius_m)
      << "not part of the row: whoever compares with the paper sets it to 0";
  EXPECT_TRUE(MakeStrategy(options).ok());
}

TEST(StrategyTable, MakesOursGoForInformationPerSecondWhereverItIs) {
  PlanningOptions options;
  options.strategy = "mit";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  options.strategy = "plumescout";
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.goal_policy, GoalPolicy::kEverything);
  EXPECT_EQ(options.paths, PathKind::kXit);
  EXPECT_EQ(options.cost, CostKind::kUcb);
  EXPECT_EQ(options.selection_cost, CostKind::kUcb);
  EXPECT_EQ(options.selection_rule, SelectionRule::kInformationRate);
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
  options.sample_count = 0;
  EXPECT_EQ(MakeStrategy(options).status().code(), absl::StatusCode::kInvalidArgument);
}

// The region of [LHR] section IV, at its speed and dwell time.
PlanningOptions LhrOptions(const std::string& strategy = "lhr") {
  PlanningOptions options;
  options.strategy = strategy;
  EXPECT_TRUE(ApplyStrategyRow(options).ok());
  options.speed_mps = 5.0;
  options.dwell_s = 2.0;
  options.sites.region = Rectangle{{-0.5, -0.5}, {50.5, 50.5}};
  return options;
}

void ExpectRefused(const PlanningOptions& options, const std::string& beginning) {
  const absl::Status status = MakeStrategy(options).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_THAT(std::string(status.message()), ::testing::StartsWith(beginning));
}

TEST(SamplingStrategies, TakeThePapersNumbers) {
  for (const char* name : {"lhr", "random_sampling", "sweep", "ipp_reward"}) {
    EXPECT_TRUE(MakeStrategy(LhrOptions(name)).ok()) << name;
  }
  const PlanningOptions options = LhrOptions();
  EXPECT_EQ(options.sites.survey_stride, 10);
  EXPECT_EQ(options.sites.candidate_count, 15);
  EXPECT_EQ(options.sites.cycle_sample_count, 10);
  EXPECT_EQ(options.sites.update_period_s, 50.0);
}

TEST(SamplingStrategies, RowsBringTheRewardsOfTheirPapers) {
  PlanningOptions options = LhrOptions("ipp_reward");
  EXPECT_EQ(options.sites.reward, SamplingReward::kConcentrationVariancePerTime);
  options.strategy = "lhr";  // on top of another row
  ASSERT_TRUE(ApplyStrategyRow(options).ok());
  EXPECT_EQ(options.sites.reward, SamplingReward::kUcb);
  EXPECT_TRUE(MakeStrategy(options).ok());
}

TEST(SamplingStrategies, ThatMakeATourWantARegion) {
  for (const char* name : {"lhr", "random_sampling", "sweep"}) {
    PlanningOptions options = LhrOptions(name);
    options.sites.region.reset();
    ExpectRefused(options, "planning.sites.region ");
  }
  PlanningOptions options = LhrOptions("ipp_reward");
  options.sites.region.reset();
  EXPECT_TRUE(MakeStrategy(options).ok());
}

TEST(SamplingStrategies, WantARegionOfWholeSquares) {
  for (const char* name : {"lhr", "random_sampling", "sweep", "ipp_reward"}) {
    PlanningOptions options = LhrOptions(name);
    options.sites.region->max.x_m = 50.0;
    ExpectRefused(options, "planning.sites.region ");
    options.sites.region = Rectangle{{0, 0}, {2000, 2000}};
    ExpectRefused(options, "planning.sites.region ");
  }
}

TEST(SamplingStrategies, WantASurveyStrideThatDividesTheRegion) {
  for (const char* name : {"lhr", "random_sampling"}) {
    PlanningOptions options = LhrOptions(name);
    options.sites.survey_stride = 7;
    ExpectRefused(options, "planning.sites.survey_stride ");
    options.sites.survey_stride = 1;
    ExpectRefused(options, "planning.sites.survey_stride ");  // 2601 sites
    options.sites.survey = false;
    EXPECT_TRUE(MakeStrategy(options).ok());
  }
  PlanningOptions options = LhrOptions("sweep");
  options.sites.survey_stride = 7;
  EXPECT_TRUE(MakeStrategy(options).ok()) << "it makes no survey";
}

// T t_sam + T d_res / V = 10 (2 + 1/5) = 22 s.
TEST(SamplingStrategies, WantUpdatePeriodsAboveTheBoundOfRemark1) {
  for (const char* name : {"lhr", "random_sampling"}) {
    PlanningOptions options = LhrOptions(name);
    options.sites.update_period_s = 22.0;
    EXPECT_TRUE(MakeStrategy(options).ok()) << MakeStrategy(options).status();
    options.sites.update_period_s = 21.99;
    ExpectRefused(options, "planning.sites.update_period_s ");
    EXPECT_THAT(std::string(MakeStrategy(options).status().message()), HasSubstr("Remark 1"));
  }
  PlanningOptions options = LhrOptions("sweep");
  options.sites.update_period_s = 1.0;
  EXPECT_TRUE(MakeStrategy(options).ok()) << "it has no cycles";
}

TEST(SamplingStrategies, RefuseMoreSamplesThanCandidates) {
  PlanningOptions options = LhrOptions();
  options.sites.cycle_sample_count = 16;
  ExpectRefused(options, "planning.sites.cycle_sample_count ");
  options.sites.candidate_count = 16;
  EXPECT_TRUE(MakeStrategy(options).ok());
  options.sites.candidate_count = 17;
  ExpectRefused(options, "planning.sites.candidate_count ");
}

TEST(SamplingStrategies, LhrCannotAddUpRewardsPerTime) {
  PlanningOptions options = LhrOptions();
  for (const auto reward : {SamplingReward::kVariancePerTime, SamplingReward::kConcentrationPerTime,
                            SamplingReward::kConcentrationVariancePerTime}) {
    options.sites.reward = reward;
    ExpectRefused(options, "planning.sites.reward ");
  }
  options.sites.reward = SamplingReward::kMean;
  EXPECT_TRUE(MakeStrategy(options).ok());
}

TEST(SamplesOnce, IsOfAllButRewardsThatBringARobotBack) {
  for (const char* name : {"lhr", "random_sampling", "sweep"}) {
    EXPECT_TRUE(SamplesOnce(LhrOptions(name))) << name;
  }
  PlanningOptions options = LhrOptions("ipp_reward");
  EXPECT_FALSE(SamplesOnce(options));
  options.sites.reward = SamplingReward::kConcentrationPerTime;  // [IPP] Eq. (12)
  EXPECT_TRUE(SamplesOnce(options));
  EXPECT_FALSE(SamplesOnce(LhrOptions("xit_gff")));
  options.strategy = "teleport";
  EXPECT_FALSE(SamplesOnce(options));
}

}  // namespace strategy_test
}  // namespace plumescout
