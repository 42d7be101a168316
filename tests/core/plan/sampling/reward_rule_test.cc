// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/plan/sampling/sampling_rule.h"
#include "tests/support/site_case.h"

namespace plumescout {
namespace reward_rule_test {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::SiteCase;
using ::testing::SizeIs;

SamplingChoice Choose(const SiteCase& c) {
  const Sites sites = c.Find();
  const GoalQuery robot = c.Query();
  const StopFn never = NeverStop();
  const auto choice = MakeRewardRule()->Choose({robot, c.At(c.start), sites, 1, never});
  EXPECT_TRUE(choice.ok()) << choice.status();
  return choice.ok() ? *choice : SamplingChoice{};
}

Cell First(const SamplingChoice& choice) { return choice.errands.at(0).stops.at(0).cell; }

// A corridor of 40 cells with the robot in the west; gas and doubt where a test puts them.
SiteCase Corridor(SamplingReward reward) {
  SiteCase c(testing::OpenArt(40, 1));
  c.options.sites.reward = reward;
  c.options.dwell_s = 1.0;
  c.options.max_goal_count = 5;
  return c;
}

// More doubt far away, most of it for its distance near by.
SiteCase DoubtFarAndNear(SamplingReward reward) {
  SiteCase c = Corridor(reward);
  testing::SetVariance(c.belief, {5, 0}, 1.0F);   // C = 1.5 s: 0.667 per second
  testing::SetVariance(c.belief, {35, 0}, 2.0F);  // C = 4.5 s: 0.444
  return c;
}

TEST(RewardRule, GoesForTheGreatestVarianceHoweverFar) {
  const SamplingChoice choice = Choose(DoubtFarAndNear(SamplingReward::kVariance));
  EXPECT_EQ(First(choice), (Cell{35, 0}));
  EXPECT_EQ(choice.phase, MissionPhase::kSampling);
  EXPECT_NEAR(choice.errands[0].reward, 2.0, 1e-9);
  EXPECT_THAT(choice.merit, HasSubstr("variance, 2"));
}

TEST(RewardRule, WeighsVarianceByTheTimeItTakes) {
  const SamplingChoice choice = Choose(DoubtFarAndNear(SamplingReward::kVariancePerTime));
  EXPECT_EQ(First(choice), (Cell{5, 0}));
  EXPECT_NEAR(choice.errands[0].reward, 1.0 / 1.5, 1e-6);
  EXPECT_EQ(choice.errands.at(1).stops.at(0).cell, (Cell{35, 0}));
}

TEST(RewardRule, WithoutGasTheConcentrationIsNoReasonToGoAnywhere) {
  const SamplingChoice choice = Choose(Corridor(SamplingReward::kConcentrationPerTime));
  EXPECT_EQ(First(choice), (Cell{0, 0})) << "V = 1 everywhere: the nearest";
}

TEST(RewardRule, OffersTheBestFewEachWithOneStopAndFallingRewards) {
  SiteCase c = DoubtFarAndNear(SamplingReward::kVariance);
  const SamplingChoice choice = Choose(c);
  ASSERT_THAT(choice.errands, SizeIs(5));
  for (std::size_t i = 1; i < choice.errands.size(); ++i) {
    EXPECT_THAT(choice.errands[i].stops, SizeIs(1));
    EXPECT_GE(choice.errands[i - 1].reward, choice.errands[i].reward);
  }
  EXPECT_EQ(choice.errands[2].stops[0].index, 0u) << "of equal ones the first of the lattice";
}

TEST(RewardRule, ReturnsToASiteUnlessConcentrationPerTimeIsTheReward) {
  for (const auto reward :
       {SamplingReward::kVariance, SamplingReward::kVariancePerTime,
        SamplingReward::kConcentrationVariance, SamplingReward::kConcentrationPerTime,
        SamplingReward::kConcentrationVariancePerTime}) {
    SiteCase c = Corridor(reward);
    testing::SetSampled(c.belief, {{7, 0}});
    testing::SetMean(c.belief, {7, 0}, 100.0F);
    testing::SetVariance(c.belief, {7, 0}, 1.0F);
    // [IPP] section III: "no location shall be visited twice", Eq. (12).
    const bool once = reward == SamplingReward::kConcentrationPerTime;
    EXPECT_EQ(First(Choose(c)) == (Cell{7, 0}), !once);
  }
}

TEST(RewardRule, HasNothingLeftOnceAllIsSampledAndNoPlaceCountsTwice) {
  SiteCase c(testing::OpenArt(3, 1));
  c.options.sites.reward = SamplingReward::kConcentrationPerTime;
  testing::SetSampled(c.belief, {{0, 0}, {1, 0}, {2, 0}});
  const SamplingChoice choice = Choose(c);
  EXPECT_THAT(choice.errands, IsEmpty());
}

TEST(RewardRule, DoesNotStayWhereSamplingTakesNoTime) {
  SiteCase c = Corridor(SamplingReward::kVariancePerTime);
  c.options.dwell_s = 0.0;
  testing::SetVariance(c.belief, {0, 0}, 9.0F);
  testing::SetVariance(c.belief, {3, 0}, 1.0F);
  EXPECT_EQ(First(Choose(c)), (Cell{3, 0}));
}

TEST(RewardRule, CountsTheWayRoundObstaclesNotTheStraightLine) {
  const testing::GridArt art = {"....#.",  //
                                "S...#.",  //
                                "....#.",  //
                                "......"};
  SiteCase c(art);
  c.options.sites.reward = SamplingReward::kVariancePerTime;
  c.options.dwell_s = 0.1;
  testing::SetVariance(c.belief, {5, 3}, 1.0F);  // 0.54 m as the crow flies
  testing::SetVariance(c.belief, {0, 0}, 0.4F);  // 0.2 m
  // Two steps down to row 0 at (3, 0) are 1 + 2 sqrt 2 cells on, then two east and three north.
  const SamplingChoice choice = Choose(c);
  const double way_m = c.Find().offered.back().travel_m;
  EXPECT_NEAR(way_m, 0.1 * (2 * std::sqrt(2.0) + 1 + 2 + 3), 1e-9);
  EXPECT_EQ(First(choice), (Cell{0, 0})) << 0.4 / 0.3 << " against " << 1.0 / (way_m + 0.1);
}

}  // namespace reward_rule_test
}  // namespace plumescout
