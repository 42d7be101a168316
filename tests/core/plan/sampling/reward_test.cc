// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/sampling/reward.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace reward_test {

constexpr double kRounding = 1e-12;

// 6 m away, of mean 8 ppm and variance 0.5 ppm^2.
Site NearGas() {
  Site site;
  site.travel_m = 6.0;
  site.mean_ppm = 8.0;
  site.variance_ppm2 = 0.5;
  return site;
}

// At 1.5 m/s and 10 s there, on a map with a mean of 2 ppm: C = 14 s, V = 4.
RewardTerms Terms(SamplingReward reward) { return {reward, 3.0, 1.5, 10.0, 2.0}; }

double Reward(SamplingReward reward) { return RewardOf(NearGas(), Terms(reward)); }

TEST(SampleTime, IsDrivingAndSampling) {
  EXPECT_NEAR(SampleTime_s(NearGas(), Terms(SamplingReward::kVariance)), 14.0, kRounding);
}

TEST(RewardOf, IsWhatTheEquationsSay) {
  EXPECT_NEAR(Reward(SamplingReward::kVariance), 0.5, kRounding);                     // (8)
  EXPECT_NEAR(Reward(SamplingReward::kVariancePerTime), 0.5 / 14.0, kRounding);       // (9)
  EXPECT_NEAR(Reward(SamplingReward::kConcentrationVariance), 2.0, kRounding);        // (11)
  EXPECT_NEAR(Reward(SamplingReward::kConcentrationPerTime), 4.0 / 14.0, kRounding);  // (12)
  EXPECT_NEAR(Reward(SamplingReward::kConcentrationVariancePerTime), 2.0 / 14.0,
              kRounding);                                      // (13)
  EXPECT_NEAR(Reward(SamplingReward::kMean), 8.0, kRounding);  // [LHR] section IV
  EXPECT_NEAR(Reward(SamplingReward::kUcb), 9.5, kRounding);   // 8 + 3 * 0.5
}

TEST(NormalisedConcentration, IsOneWhileTheMapHoldsNoGas) {
  RewardTerms terms = Terms(SamplingReward::kConcentrationVariance);
  terms.map_mean_ppm = 0.0;
  Site site = NearGas();
  site.mean_ppm = 0.0;
  EXPECT_EQ(NormalisedConcentration(site, terms), 1.0) << "0/0";
  EXPECT_NEAR(RewardOf(site, terms), 0.5, kRounding) << "then variance alone counts";
}

TEST(NormalisedConcentration, DoesNotTurnTheOrderRoundOnAMapBelowTheBackground) {
  RewardTerms terms = Terms(SamplingReward::kConcentrationVariance);
  terms.map_mean_ppm = -0.1;
  EXPECT_EQ(NormalisedConcentration(NearGas(), terms), 1.0);
}

TEST(NormalisedConcentration, OfASiteBelowTheBackgroundIsNegative) {
  Site site = NearGas();
  site.mean_ppm = -1.0;
  EXPECT_NEAR(NormalisedConcentration(site, Terms(SamplingReward::kConcentrationPerTime)), -0.5,
              kRounding);
}

TEST(IsPerTime, KnowsTheRewardsThatAreDividedByIt) {
  EXPECT_TRUE(IsPerTime(SamplingReward::kVariancePerTime));
  EXPECT_TRUE(IsPerTime(SamplingReward::kConcentrationPerTime));
  EXPECT_TRUE(IsPerTime(SamplingReward::kConcentrationVariancePerTime));
  EXPECT_FALSE(IsPerTime(SamplingReward::kVariance));
  EXPECT_FALSE(IsPerTime(SamplingReward::kConcentrationVariance));
  EXPECT_FALSE(IsPerTime(SamplingReward::kMean));
  EXPECT_FALSE(IsPerTime(SamplingReward::kUcb));
}

}  // namespace reward_test
}  // namespace plumescout
