// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/selection.h"

#include <gtest/gtest.h>

namespace plumescout {
namespace {

Candidate Priced(double cost, double mean_ucb) {
  Candidate candidate;
  candidate.cost = cost;
  candidate.mean_ucb = mean_ucb;
  return candidate;
}

TEST(SelectCandidate, TakesTheLeastCost) {
  EXPECT_EQ(
      SelectCandidate({Priced(3, 0.9), Priced(1, 0.1), Priced(2, 0.5)}, SelectionRule::kLeastCost),
      1);
}

TEST(SelectCandidate, TakesTheGreatestMeanInformation) {
  EXPECT_EQ(
      SelectCandidate({Priced(3, 0.2), Priced(1, 0.1), Priced(2, 0.5)}, SelectionRule::kMeanUcb),
      2);
}

TEST(SelectCandidate, TakesTheFirstOfEquals) {
  EXPECT_EQ(
      SelectCandidate({Priced(3, 0.5), Priced(2, 0.5), Priced(2, 0.5)}, SelectionRule::kLeastCost),
      1);
  EXPECT_EQ(SelectCandidate({Priced(3, 0.5), Priced(2, 0.5)}, SelectionRule::kMeanUcb), 0);
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
                            SelectionRule::kInformationRate),
            1);
}

TEST(SelectCandidate, CountsWhatIsUnseenBehindAnOccupancyFrontier) {
  Candidate frontier = Informed(1, 10);
  frontier.goal.kind = GoalKind::kOccupancyFrontier;
  EXPECT_DOUBLE_EQ(Worth_nats(frontier), 1 + kUnseen_nats);
  EXPECT_DOUBLE_EQ(Worth_nats(Informed(1, 10)), 1.0);
  const auto rate = SelectionRule::kInformationRate;
  EXPECT_EQ(SelectCandidate({Informed(0.9 + kUnseen_nats, 10), frontier}, rate), 1);
  EXPECT_EQ(SelectCandidate({Informed(1.1 + kUnseen_nats, 10), frontier}, rate), 0);
  EXPECT_TRUE(BeatsByMargin(frontier, Informed(1, 10), rate, 1.0));
}

TEST(SelectCandidate, PassesOverWhatWasNotPricedUnlessNothingWas) {
  EXPECT_EQ(SelectCandidate({Priced(1, 0.1), Informed(0, 10)}, SelectionRule::kInformationRate), 1);
  EXPECT_EQ(SelectCandidate({Priced(3, 0.1), Priced(1, 0.1)}, SelectionRule::kInformationRate), 1);
}

TEST(BeatsByMargin, AsksForAShareOfTheKeptOnesMerit) {
  const auto cost = SelectionRule::kLeastCost;
  EXPECT_TRUE(BeatsByMargin(Priced(7, 0), Priced(10, 0), cost, 0.2));
  EXPECT_FALSE(BeatsByMargin(Priced(9, 0), Priced(10, 0), cost, 0.2));
  EXPECT_TRUE(BeatsByMargin(Priced(0, 0.7), Priced(0, 0.5), SelectionRule::kMeanUcb, 0.2));
  EXPECT_FALSE(BeatsByMargin(Priced(0, 0.55), Priced(0, 0.5), SelectionRule::kMeanUcb, 0.2));
  const auto rate = SelectionRule::kInformationRate;
  EXPECT_TRUE(BeatsByMargin(Informed(13, 10), Informed(10, 10), rate, 0.2));
  EXPECT_FALSE(BeatsByMargin(Informed(11, 10), Informed(10, 10), rate, 0.2));
  EXPECT_FALSE(BeatsByMargin(Priced(1, 0), Priced(1, 0), cost, 0.0));
}

TEST(SelectCandidate, OfNoneIsNone) {
  EXPECT_EQ(SelectCandidate({}, SelectionRule::kLeastCost), -1);
}

}  // namespace
}  // namespace plumescout
