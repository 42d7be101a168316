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

TEST(SelectCandidate, OfNoneIsNone) {
  EXPECT_EQ(SelectCandidate({}, SelectionRule::kLeastCost), -1);
}

}  // namespace
}  // namespace plumescout
