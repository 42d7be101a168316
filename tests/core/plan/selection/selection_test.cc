// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/selection.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumescout {
namespace selection_test {

PlanningOptions By(SelectionRule rule, double margin = 0.0) {
  PlanningOptions options;
  options.selection_rule = rule;
  options.commitment_margin_share = margin;
  return options;
}

Candidate Priced(double cost, double mean_ucb) {
  Candidate candidate;
  candidate.cost = cost;
  candidate.mean_ucb = mean_ucb;
  return candidate;
}

TEST(SelectCandidate, TakesTheLeastCost) {
  EXPECT_EQ(SelectCandidate({Priced(3, 0.9), Priced(1, 0.1), Priced(2, 0.5)},
                            By(SelectionRule::kLeastCost)),
            1);
}

TEST(SelectCandidate, TakesTheGreatestMeanInformation) {
  EXPECT_EQ(SelectCandidate({Priced(3, 0.2), Priced(1, 0.1), Priced(2, 0.5)},
                            By(SelectionRule::kMeanUcb)),
            2);
}

TEST(SelectCandidate, TakesTheFirstOfEquals) {
  EXPECT_EQ(SelectCandidate({Priced(3, 0.5), Priced(2, 0.5), Priced(2, 0.5)},
                            By(SelectionRule::kLeastCost)),
            1);
  EXPECT_EQ(SelectCandidate({Priced(3, 0.5), Priced(2, 0.5)}, By(SelectionRule::kMeanUcb)), 0);
}

Candidate Informed(double nats, double duration_s) {
  Candidate candidate;
  candidate.goal.kind = GoalKind::kGasFrontier;
  candidate.expected_information_nats = nats;
  candidate.duration_s = duration_s;
  return candidate;
}

TEST(SelectCandidate, TakesTheMostInformationPerSecond) {
  EXPECT_EQ(SelectCandidate({Informed(10, 10), Informed(8, 4), Informed(20, 30)},
                            By(SelectionRule::kInformationRate)),
            1);
}

TEST(SelectCandidate, CountsWhatIsUnseenBehindAnOccupancyFrontier) {
  Candidate frontier = Informed(1, 10);
  frontier.goal.kind = GoalKind::kOccupancyFrontier;
  PlanningOptions options = By(SelectionRule::kInformationRate, 1.0);
  EXPECT_DOUBLE_EQ(Worth_nats(frontier, options), 21.0);
  EXPECT_DOUBLE_EQ(Worth_nats(Informed(1, 10), options), 1.0);
  EXPECT_EQ(SelectCandidate({Informed(20.9, 10), frontier}, options), 1);
  EXPECT_EQ(SelectCandidate({Informed(21.1, 10), frontier}, options), 0);
  EXPECT_TRUE(BeatsByMargin(frontier, Informed(1, 10), options));
}

TEST(SelectCandidate, CountsWhatIsUnseenAsMuchAsItIsTold) {
  Candidate frontier = Informed(1, 10);
  frontier.goal.kind = GoalKind::kOccupancyFrontier;
  PlanningOptions options = By(SelectionRule::kInformationRate, 1.0);
  options.unseen_information_nats = 4.0;
  EXPECT_EQ(SelectCandidate({Informed(4.9, 10), frontier}, options), 1);
  EXPECT_EQ(SelectCandidate({Informed(5.1, 10), frontier}, options), 0);
  options.unseen_information_nats = 0.0;
  EXPECT_EQ(SelectCandidate({Informed(1.1, 10), frontier}, options), 0);
  EXPECT_FALSE(BeatsByMargin(frontier, Informed(1, 10), options));
}

TEST(SelectCandidate, CountsOfTheUnseenWhatOthersLeave) {
  Candidate frontier = Informed(1, 10);
  frontier.goal.kind = GoalKind::kOccupancyFrontier;
  frontier.unseen_share = 0.25;
  const PlanningOptions options = By(SelectionRule::kInformationRate);
  EXPECT_DOUBLE_EQ(Worth_nats(frontier, options), 6.0);
  EXPECT_DOUBLE_EQ(InformationRate(frontier, 2.0, options), 0.7);
  EXPECT_EQ(SelectCandidate({Informed(5.9, 10), frontier}, options), 1);
  EXPECT_EQ(SelectCandidate({Informed(6.1, 10), frontier}, options), 0);
}

TEST(InField, CountsWhatIsUnseenByWhatAReadingTells) {
  PlanningOptions options;
  options.unseen_information_nats = 12.0;
  GasOptions gas = PublishedGasOptions();
  EXPECT_DOUBLE_EQ(InField(options, gas).unseen_information_nats, 12.0);
  // ln(32 lambda_p / lambda_d) / (4 pi lambda_p) is 0.30431 ppm^2 and, with 0.1, 6.4227 ppm^2.
  gas.prior_precision_per_ppm2 = 0.1;
  EXPECT_NEAR(InField(options, gas).unseen_information_nats,
              12.0 * std::log(1.0 + 64.227) / std::log(1.0 + 3.0431), 0.005);
  gas.observation_precision_per_ppm2 = 1e-9;
  EXPECT_LT(InField(options, gas).unseen_information_nats, 1e-6) << "readings that tell nothing";
  options.unseen_information_nats = 0.0;
  EXPECT_EQ(InField(options, PublishedGasOptions()).unseen_information_nats, 0.0);
}

TEST(SelectCandidate, PassesOverWhatWasNotPricedUnlessNothingWas) {
  EXPECT_EQ(SelectCandidate({Priced(1, 0.1), Informed(0, 10)}, By(SelectionRule::kInformationRate)),
            1);
  EXPECT_EQ(SelectCandidate({Priced(3, 0.1), Priced(1, 0.1)}, By(SelectionRule::kInformationRate)),
            1);
}

TEST(BeatsByMargin, AsksForAShareOfTheKeptOnesMerit) {
  const PlanningOptions cost = By(SelectionRule::kLeastCost, 0.2);
  EXPECT_TRUE(BeatsByMargin(Priced(7, 0), Priced(10, 0), cost));
  EXPECT_FALSE(BeatsByMargin(Priced(9, 0), Priced(10, 0), cost));
  const PlanningOptions ucb = By(SelectionRule::kMeanUcb, 0.2);
  EXPECT_TRUE(BeatsByMargin(Priced(0, 0.7), Priced(0, 0.5), ucb));
  EXPECT_FALSE(BeatsByMargin(Priced(0, 0.55), Priced(0, 0.5), ucb));
  const PlanningOptions rate = By(SelectionRule::kInformationRate, 0.2);
  EXPECT_TRUE(BeatsByMargin(Informed(13, 10), Informed(10, 10), rate));
  EXPECT_FALSE(BeatsByMargin(Informed(11, 10), Informed(10, 10), rate));
  EXPECT_FALSE(BeatsByMargin(Priced(1, 0), Priced(1, 0), By(SelectionRule::kLeastCost)));
}

TEST(SelectCandidate, OfNoneIsNone) {
  EXPECT_EQ(SelectCandidate({}, By(SelectionRule::kLeastCost)), -1);
}

}  // namespace selection_test
}  // namespace plumescout
