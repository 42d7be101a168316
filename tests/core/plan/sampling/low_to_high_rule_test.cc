// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/plan/sampling/sampling_rule.h"
#include "core/types/rng.h"
#include "tests/support/site_case.h"

namespace plumescout {
namespace low_to_high_rule_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::SiteCase;
using ::testing::SizeIs;

SamplingChoice Choose(const SiteCase& c, bool at_random = false, std::uint64_t seed = 1) {
  const Sites sites = c.Find();
  const GoalQuery robot = c.Query();
  const StopFn never = NeverStop();
  const auto choice =
      MakeLowToHighRule(at_random)->Choose({robot, c.At(c.start), sites, seed, never});
  EXPECT_TRUE(choice.ok()) << choice.status();
  return choice.ok() ? *choice : SamplingChoice{};
}

std::vector<std::size_t> Indices(const Errand& errand) {
  std::vector<std::size_t> indices;
  for (const Site& site : errand.stops) indices.push_back(site.index);
  return indices;
}

double Drive_m(Point2 start, const Errand& errand) {
  double length_m = 0.0;
  for (const Site& site : errand.stops) {
    length_m += Distance_m(start, site.place);
    start = site.place;
  }
  return length_m;
}

// (P2) of [LHR] by trying every subset and every order, in open space.
struct BruteForce {
  Point2 start;
  std::vector<Site> candidates;
  double speed_mps;
  double dwell_s;
  double cycle_s;

  // H(T_k) of Eq. (3): ends at the one farthest from the robot.
  double Shortest_m(std::vector<std::size_t> subset) const {
    const auto far =
        std::max_element(subset.begin(), subset.end(), [&](std::size_t a, std::size_t b) {
          return Distance_m(start, candidates[a].place) < Distance_m(start, candidates[b].place);
        });
    std::iter_swap(far, subset.end() - 1);
    std::sort(subset.begin(), subset.end() - 1);
    double least_m = std::numeric_limits<double>::infinity();
    do {
      Errand errand;
      for (const std::size_t i : subset) errand.stops.push_back(candidates[i]);
      least_m = std::min(least_m, Drive_m(start, errand));
    } while (std::next_permutation(subset.begin(), subset.end() - 1));
    return least_m;
  }

  // The greatest sum of rewards of `wanted` of them, -1 if no subset fits.
  double BestReward(std::size_t wanted, const std::vector<double>& rewards) const {
    double best = -1.0;
    for (unsigned mask = 0; mask < (1U << candidates.size()); ++mask) {
      std::vector<std::size_t> subset;
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        if ((mask >> i & 1U) != 0U) subset.push_back(i);
      }
      if (subset.size() != wanted) continue;
      const double left_s = cycle_s - static_cast<double>(wanted) * dwell_s;
      if (Shortest_m(subset) > left_s * speed_mps) continue;
      double sum = 0.0;
      for (const std::size_t i : subset) sum += rewards[i];
      best = std::max(best, sum);
    }
    return best;
  }
};

// An open yard, all means different and at random.
SiteCase GassyYard(Rng& rng) {
  SiteCase c(testing::OpenArt(12, 10, {3, 4}));
  Grid<float> mean(c.belief.geometry(), 0.0F);
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = static_cast<float>(rng.Uniform01());
  c.belief.gas_mean_ppm = std::make_shared<const Grid<float>>(mean);
  c.options.sites.reward = SamplingReward::kMean;
  return c;
}

TEST(LowToHighRule, TakesTheBestFeasibleSetByBruteForce) {
  Rng rng(3);
  int tight = 0;
  for (int round = 0; round < 40; ++round) {
    SiteCase c = GassyYard(rng);
    c.options.sites.candidate_count = 6;
    c.options.sites.cycle_sample_count = 1 + round % 5;
    c.options.dwell_s = 0.1;
    c.options.sites.update_period_s =
        c.options.sites.cycle_sample_count * 0.1 + rng.Uniform(0.5, 3.0);
    std::vector<Site> by_reward = c.Find().offered;
    std::stable_sort(by_reward.begin(), by_reward.end(),
                     [](const Site& a, const Site& b) { return a.mean_ppm > b.mean_ppm; });
    by_reward.resize(6);
    std::vector<double> rewards;
    for (const Site& site : by_reward) rewards.push_back(site.mean_ppm);
    const BruteForce oracle{c.At(c.start), by_reward, 1.0, 0.1, c.options.sites.update_period_s};
    std::size_t wanted = static_cast<std::size_t>(c.options.sites.cycle_sample_count);
    while (wanted > 0 && oracle.BestReward(wanted, rewards) < 0.0) --wanted;

    const SamplingChoice choice = Choose(c);
    ASSERT_THAT(choice.errands, SizeIs(1));
    const Errand& errand = choice.errands[0];
    if (wanted == 0) continue;  // see NotEvenOneFits
    if (wanted < static_cast<std::size_t>(c.options.sites.cycle_sample_count)) ++tight;
    EXPECT_THAT(errand.stops, SizeIs(wanted));
    EXPECT_NEAR(errand.reward, oracle.BestReward(wanted, rewards), 1e-9);
    const double spent_s = Drive_m(c.At(c.start), errand) + 0.1 * static_cast<double>(wanted);
    EXPECT_LE(spent_s, c.options.sites.update_period_s + 1e-9);
    std::vector<std::size_t> subset;
    for (const Site& stop : errand.stops) {
      const auto at = std::find_if(by_reward.begin(), by_reward.end(),
                                   [&](const Site& s) { return s.index == stop.index; });
      ASSERT_NE(at, by_reward.end()) << "only of the first M of the sorted rewards";
      subset.push_back(static_cast<std::size_t>(at - by_reward.begin()));
    }
    EXPECT_NEAR(Drive_m(c.At(c.start), errand), oracle.Shortest_m(subset), 1e-9);
  }
  EXPECT_GT(tight, 0) << "some cycles were too short for all T";
}

TEST(LowToHighRule, TakesAllThatIsLeftIfItIsLessThanACycle) {
  SiteCase c(testing::OpenArt(5, 1));
  testing::SetSampled(c.belief, {{0, 0}, {3, 0}});
  const SamplingChoice choice = Choose(c);
  ASSERT_THAT(choice.errands, SizeIs(1));
  EXPECT_THAT(Indices(choice.errands[0]), ::testing::ElementsAre(1, 2, 4));
  EXPECT_EQ(choice.phase, MissionPhase::kSampling);
}

TEST(LowToHighRule, HasNothingLeftOnceAllIsSampled) {
  SiteCase c(testing::OpenArt(2, 1));
  c.options.sites.survey = true;
  c.options.sites.survey_stride = 1;
  testing::SetSampled(c.belief, {{0, 0}, {1, 0}});
  EXPECT_THAT(Choose(c).errands, IsEmpty());
}

TEST(LowToHighRule, SixteenCandidatesAreTheMost) {
  Rng rng(5);
  SiteCase c = GassyYard(rng);
  c.options.sites.candidate_count = 16;
  c.options.sites.cycle_sample_count = 10;
  c.options.sites.update_period_s = 1000.0;
  const SamplingChoice choice = Choose(c);
  // Everything fits: the ten best.
  std::vector<double> means;
  for (const Site& site : c.Find().offered) means.push_back(site.mean_ppm);
  std::sort(means.rbegin(), means.rend());
  EXPECT_NEAR(choice.errands.at(0).reward, std::accumulate(means.begin(), means.begin() + 10, 0.0),
              1e-9);
  EXPECT_THAT(choice.merit, HasSubstr("of 8008 sets of the best 16"));  // 16 choose 10
}

TEST(LowToHighRule, IfNotEvenOneFitsItTakesTheNearestOfTheCandidates) {
  SiteCase c(testing::OpenArt(40, 1));
  c.options.sites.reward = SamplingReward::kMean;
  c.options.sites.candidate_count = 2;
  c.options.sites.cycle_sample_count = 1;
  c.options.sites.update_period_s = 2.5;  // 0.5 m
  testing::SetMean(c.belief, {39, 0}, 9.0F);
  testing::SetMean(c.belief, {30, 0}, 8.0F);
  const SamplingChoice choice = Choose(c);
  EXPECT_THAT(Indices(choice.errands.at(0)), ::testing::ElementsAre(30));
  EXPECT_THAT(choice.merit, HasSubstr("near enough"));
}

TEST(LowToHighRule, DrivesRoundObstacles) {
  const testing::GridArt art = {"...#...",  //
                                "...#...",  //
                                "S..#...",  //
                                "...#...",  //
                                "......."};
  SiteCase c(art);
  c.options.sites.reward = SamplingReward::kMean;
  c.options.sites.candidate_count = 2;
  c.options.sites.cycle_sample_count = 2;
  c.options.sites.update_period_s = 5.2;     // 1.2 m for both
  testing::SetMean(c.belief, {4, 4}, 9.0F);  // 0.45 m away, but 0.98 m or more to drive
  testing::SetMean(c.belief, {0, 4}, 8.0F);  // 0.2 m
  const SamplingChoice choice = Choose(c);
  EXPECT_THAT(choice.errands.at(0).stops, SizeIs(1)) << "as the crow flies both would fit";
  EXPECT_EQ(choice.errands[0].stops[0].cell, (Cell{4, 4}));
}

TEST(LowToHighRule, SurveysFirstIfItIsToldSo) {
  SiteCase c(testing::OpenArt(5, 5));
  c.options.sites.survey_stride = 2;
  c.options.sites.survey = true;
  EXPECT_EQ(Choose(c).phase, MissionPhase::kSurvey);
  EXPECT_THAT(Choose(c).errands.at(0).stops, SizeIs(9));
  EXPECT_THAT(Choose(c).merit, HasSubstr("survey, 9 sites"));
  c.options.sites.survey = false;
  EXPECT_EQ(Choose(c).phase, MissionPhase::kSampling);
}

TEST(LowToHighRule, SamplesOnceTheSurveyIsDone) {
  SiteCase c(testing::OpenArt(3, 3));
  c.options.sites.survey = true;
  c.options.sites.survey_stride = 2;
  testing::SetSampled(c.belief, {{0, 0}, {2, 0}, {0, 2}, {2, 2}});
  const SamplingChoice choice = Choose(c);
  EXPECT_EQ(choice.phase, MissionPhase::kSampling);
  EXPECT_THAT(choice.errands.at(0).stops, SizeIs(5));
}

TEST(RandomSampling, FollowsItsSeedAfterTheSurvey) {
  SiteCase c(testing::OpenArt(20, 20));
  c.options.sites.survey = true;
  c.options.sites.survey_stride = 19;
  const SamplingChoice survey = Choose(c, /*at_random=*/true);
  EXPECT_EQ(survey.phase, MissionPhase::kSurvey);
  EXPECT_THAT(survey.errands.at(0).stops, SizeIs(4));  // the corners
  testing::SetSampled(c.belief, {{0, 0}, {19, 0}, {0, 19}, {19, 19}});
  std::set<std::vector<std::size_t>> cycles;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const SamplingChoice choice = Choose(c, /*at_random=*/true, seed);
    EXPECT_EQ(choice.phase, MissionPhase::kSampling);
    EXPECT_THAT(choice.errands.at(0).stops, SizeIs(10));
    EXPECT_EQ(Indices(choice.errands[0]), Indices(Choose(c, true, seed).errands.at(0)));
    cycles.insert(Indices(choice.errands[0]));
  }
  EXPECT_THAT(cycles, SizeIs(5));
}

TEST(RandomSampling, DrawsEverySiteAboutAsOften) {
  SiteCase c(testing::OpenArt(4, 1));
  c.options.sites.candidate_count = 1;
  c.options.sites.cycle_sample_count = 1;
  testing::SetMean(c.belief, {2, 0}, 100.0F);  // nothing to it
  std::vector<int> draws(4, 0);
  constexpr int kDraws = 400;
  for (int seed = 1; seed <= kDraws; ++seed) {
    ++draws.at(Choose(c, true, static_cast<std::uint64_t>(seed)).errands.at(0).stops.at(0).index);
  }
  // 100 each, five standard deviations of sqrt(400 * 1/4 * 3/4).
  for (const int count : draws) EXPECT_NEAR(count, 100, 44);
}

}  // namespace low_to_high_rule_test
}  // namespace plumescout
