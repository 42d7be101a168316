// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/selection/candidate_terms.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumescout {
namespace candidate_terms_test {

constexpr double kRounding = 1e-6;  // single-precision fields

// Four cells of 0.1 m in a row: I-hat 0, 0.25, 0.5, 1.
InformationMap RowInformation() {
  InformationMap information;
  information.value = Grid<float>(GridGeometry{0.0, 0.0, 0.1, 4, 1});
  information.value.values() = {0.0F, 0.25F, 0.5F, 1.0F};
  information.penalty = Grid<float>(information.value.geometry());
  information.penalty.values() = {1.0F, 0.75F, 0.5F, 0.001F};
  information.min_penalty = 0.001F;
  return information;
}

Grid<float> RowMean() {
  Grid<float> mean_ppm(GridGeometry{0.0, 0.0, 0.1, 4, 1});
  mean_ppm.values() = {4.0F, 8.0F, std::numeric_limits<float>::quiet_NaN(), 100.0F};
  return mean_ppm;
}

// From the middle of the first cell to the middle of the third, by way of the second.
const std::vector<Point2> kPath = {{0.05, 0.05}, {0.13, 0.05}, {0.25, 0.05}};

TEST(MakeCandidate, FillsInEveryTermOfThePath) {
  const InformationMap information = RowInformation();
  const EdgeCost cost(information, CostKind::kUcb, 2.0);
  const Grid<float> mean_ppm = RowMean();
  Goal goal;
  goal.frontier_cells = 9;
  const Candidate candidate =
      MakeCandidate(goal, kPath, PathSource::kGridGuard, {cost, mean_ppm, 6.0});
  EXPECT_EQ(candidate.goal, goal);
  EXPECT_EQ(candidate.path, kPath);
  EXPECT_EQ(candidate.path_source, PathSource::kGridGuard);
  EXPECT_NEAR(candidate.information_penalty, 0.5 * 1.0 + 0.75 + 0.5 * 0.5, kRounding);
  EXPECT_NEAR(candidate.length_m, 0.2, kRounding);
  EXPECT_NEAR(candidate.cost, 1.5 + 2.0 * 0.2, kRounding);
  EXPECT_NEAR(candidate.mean_ucb, (0.5 * 0.0 + 0.25 + 0.5 * 0.5) / 2.0, kRounding);
  // The third cell has no mean yet and counts as the background.
  EXPECT_NEAR(candidate.mean_concentration_ppm, (0.5 * 4.0 + 8.0 + 0.5 * 6.0) / 2.0, kRounding);
}

TEST(MakeCandidate, ComparesBySelectionCostButReportsThePenalty) {
  const InformationMap information = RowInformation();
  const EdgeCost length(information, CostKind::kEuclidean, 0.0);
  const Grid<float> mean_ppm = RowMean();
  const Candidate candidate = MakeCandidate({}, kPath, PathSource::kTree, {length, mean_ppm, 0.0});
  EXPECT_NEAR(candidate.cost, 0.2, kRounding);
  EXPECT_NEAR(candidate.information_penalty, 1.5, kRounding);
}

TEST(MakeCandidate, OfNoLengthHasTheMeansOfItsCell) {
  const InformationMap information = RowInformation();
  const EdgeCost cost(information, CostKind::kUcb, 0.0);
  const Grid<float> mean_ppm = RowMean();
  const Candidate candidate =
      MakeCandidate({}, {{0.15, 0.05}}, PathSource::kTree, {cost, mean_ppm, 0.0});
  EXPECT_EQ(candidate.cost, 0.0);
  EXPECT_EQ(candidate.mean_ucb, 0.25);
  EXPECT_EQ(candidate.mean_concentration_ppm, 8.0);
}

}  // namespace candidate_terms_test
}  // namespace plumescout
