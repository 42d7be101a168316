// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/objective_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/gas/gas_scale.h"
#include "tests/support/measured_hall.h"

namespace plumescout {
namespace objective_cells_test {

using support::MeasuredHall;
using support::Objective;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

ObjectiveCells Judged(const MeasuredHall& hall) {
  return JudgeCells(hall.belief, *hall.belief.traversable);
}

TEST(JudgeCells, OfCleanAirTheMarginIsHowFarBelowTheThresholdItIs) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean));
  hall.Set({3, 3}, 4.0F, 4.0F);
  hall.Set({4, 4}, 16.0F, 4.0F);
  const ObjectiveCells cells = Judged(hall);
  EXPECT_FLOAT_EQ((cells.margin[Cell{3, 3}]), 3.0F);
  EXPECT_FLOAT_EQ((cells.margin[Cell{4, 4}]), -3.0F);
  EXPECT_FLOAT_EQ((cells.margin[Cell{5, 5}]), 10.0F);
  EXPECT_NEAR(cells.needed, 1.64485F, 1e-4F);
  EXPECT_TRUE(std::isnan(cells.margin[Cell{0, 0}]));  // a wall
}

TEST(JudgeCells, WhatThePriorAloneSaysDecidesNothing) {
  for (const ObjectiveKind kind : {ObjectiveKind::kMapAboveThreshold, ObjectiveKind::kConfirmClean,
                                   ObjectiveKind::kFindSources}) {
    MeasuredHall hall(Objective(kind, 0.0));
    hall.Forget({3, 3});
    EXPECT_EQ((Judged(hall).margin[Cell{3, 3}]), -kInfinity);
  }
}

TEST(JudgeCells, WhatLiesBesideMeasuredCellsIsJudgedByWhatIsKnown) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean, 0.5));
  hall.Forget({3, 3});
  EXPECT_FLOAT_EQ((Judged(hall).margin[Cell{3, 3}]), 10.0F);
  for (const Cell cell : {Cell{2, 3}, Cell{4, 3}, Cell{3, 2}, Cell{3, 4}}) hall.Forget(cell);
  EXPECT_EQ((Judged(hall).margin[Cell{3, 3}]), -kInfinity);
}

// A robot passed on one side of a wall with a door; of what is behind it, nothing was read.
TEST(JudgeCells, BesideIsNotBehindAWall) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean, 1.0));
  for (int y = 1; y <= 10; ++y) {
    for (int x = 11; x <= 20; ++x) hall.Forget({x, y});
    if (y == 5) continue;
    (*hall.occupancy)[Cell{11, y}] = CellState::kOccupied;
    (*hall.traversable)[Cell{11, y}] = 0;
    (*hall.mean)[Cell{11, y}] = NAN;
    (*hall.variance)[Cell{11, y}] = NAN;
  }
  const ObjectiveCells cells = Judged(hall);
  EXPECT_FLOAT_EQ((cells.margin[Cell{11, 5}]), 10.0F);
  EXPECT_FLOAT_EQ((cells.margin[Cell{12, 5}]), 10.0F);  // through the door
  EXPECT_EQ((cells.margin[Cell{13, 5}]), -kInfinity);
  // A metre from what was read, through the wall; farther round it.
  EXPECT_EQ((cells.margin[Cell{12, 4}]), -kInfinity);
  EXPECT_EQ((cells.margin[Cell{12, 8}]), -kInfinity);
}

TEST(JudgeCells, ASourceBehindAWallIsAnother) {
  MeasuredHall hall(Objective(ObjectiveKind::kFindSources));
  hall.Set({10, 5}, 50.0F, 9.0F);
  hall.Set({12, 5}, 49.0F, 9.0F);
  EXPECT_TRUE(std::isnan(Judged(hall).margin[Cell{12, 5}]));
  for (int y = 1; y <= 10; ++y) (*hall.occupancy)[Cell{11, y}] = CellState::kOccupied;
  EXPECT_LT((Judged(hall).margin[Cell{12, 5}]), 1.0F);
}

TEST(JudgeCells, RootsAreJudgedOnTheirScale) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean), GasScale::kSquareRoot);
  GasOptions gas;
  gas.scale = GasScale::kSquareRoot;
  const GasEstimate told = OffScale(gas, 2.0, 0.36);
  hall.Set({3, 3}, static_cast<float>(told.median_ppm), static_cast<float>(told.variance_ppm2));
  EXPECT_NEAR((Judged(hall).margin[Cell{3, 3}]), (std::sqrt(10.0) - 2.0) / 0.6, 1e-5);
}

TEST(JudgeCells, TheEdgeOfAPlumeDoesNotCount) {
  ObjectiveOptions objective = Objective(ObjectiveKind::kMapAboveThreshold);
  objective.radius_m = 1.0;
  MeasuredHall hall(objective);
  for (int x = 1; x <= 20; ++x) {
    for (int y = 1; y <= 10; ++y) {
      if (x > 5) hall.Set({x, y}, x < 9 || x > 15 ? 10.0F : 30.0F, 1.0F);
    }
  }
  const ObjectiveCells cells = Judged(hall);
  EXPECT_FLOAT_EQ((cells.margin[Cell{5, 5}]), 10.0F);
  EXPECT_FLOAT_EQ((cells.margin[Cell{9, 5}]), 20.0F);  // above is as well decided as below
  EXPECT_TRUE(std::isnan(cells.margin[Cell{6, 5}]));   // half a metre from what is decided
  EXPECT_TRUE(std::isnan(cells.margin[Cell{7, 5}]));   // a metre
  EXPECT_FLOAT_EQ((cells.margin[Cell{20, 5}]), 0.0F);  // two and a half
}

TEST(JudgeCells, ASourceIsThePlaceThatIsSurelyTheStrongest) {
  MeasuredHall hall(Objective(ObjectiveKind::kFindSources));
  hall.Set({10, 5}, 50.0F, 9.0F);
  hall.Set({11, 5}, 49.0F, 9.0F);   // beside it
  hall.Set({15, 5}, 44.0F, 16.0F);  // far off, and less sure
  hall.Set({3, 3}, 60.0F, 900.0F);  // more by the mean, but hardly known
  const ObjectiveCells cells = Judged(hall);
  ASSERT_TRUE(cells.source_found);
  EXPECT_EQ(hall.belief.geometry().CellAtIndex(*cells.strongest), (Cell{10, 5}));
  EXPECT_TRUE(std::isnan(cells.margin[Cell{10, 5}]));
  EXPECT_TRUE(std::isnan(cells.margin[Cell{11, 5}]));
  EXPECT_FLOAT_EQ((cells.margin[Cell{15, 5}]), 6.0F / 5.0F);
  EXPECT_LT((cells.margin[Cell{3, 3}]), 0.0F);
}

TEST(VerdictOf, TellsWhatBecameOfACell) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean, 0.0));
  hall.Set({4, 4}, 16.0F, 4.0F);
  hall.Set({5, 5}, 9.0F, 4.0F);
  hall.Forget({3, 3});
  const auto verdict = [&](ObjectiveKind kind, Cell cell) {
    return VerdictOf(Judged(hall), kind, hall.belief.geometry().Index(cell));
  };
  constexpr ObjectiveKind kClean = ObjectiveKind::kConfirmClean;
  EXPECT_EQ(verdict(kClean, {7, 7}), ObjectiveVerdict::kDecided);
  EXPECT_EQ(verdict(kClean, {4, 4}), ObjectiveVerdict::kRefuted);
  EXPECT_EQ(verdict(kClean, {5, 5}), ObjectiveVerdict::kUndecided);
  EXPECT_EQ(verdict(kClean, {3, 3}), ObjectiveVerdict::kNotMeasured);
  EXPECT_EQ(verdict(kClean, {0, 0}), ObjectiveVerdict::kDoesNotCount);
  // Less than the strongest place is no refutation of anything.
  EXPECT_EQ(verdict(ObjectiveKind::kFindSources, {4, 4}), ObjectiveVerdict::kUndecided);
}

TEST(JudgeCells, WithoutASourceAllIsJudgedByTheThreshold) {
  MeasuredHall hall(Objective(ObjectiveKind::kFindSources));
  hall.Set({10, 5}, 11.0F, 1.0F);  // not surely above
  const ObjectiveCells cells = Judged(hall);
  EXPECT_FALSE(cells.source_found);
  EXPECT_FLOAT_EQ((cells.margin[Cell{10, 5}]), -1.0F);
}

}  // namespace objective_cells_test
}  // namespace plumescout
