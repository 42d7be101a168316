// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/objective_truth.h"

#include <gtest/gtest.h>

#include "core/belief/objective_assessment.h"
#include "tests/support/measured_hall.h"

namespace plumescout::lab {
namespace objective_truth_test {

using support::MeasuredHall;
using support::Objective;

Scene Truth(const MeasuredHall& hall) {
  Scene scene;
  scene.occupancy = *hall.occupancy;
  scene.conc_mean_ppm = Grid<float>(hall.belief.geometry(), 0.0F);
  return scene;
}

ObjectiveTruth Judged(MeasuredHall& hall, const Scene& truth) {
  hall.belief.objective = AssessObjective(hall.belief);
  return CompareWithTruth(hall.belief, truth);
}

TEST(CompareWithTruth, CleanAirIsCleanEverywhereOrNot) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean));
  Scene truth = Truth(hall);
  EXPECT_TRUE(Judged(hall, truth).is_right);
  EXPECT_EQ(Judged(hall, truth).decided_cells, 200.0);
  truth.conc_mean_ppm[Cell{4, 4}] = 11.0F;
  const ObjectiveTruth wrong = Judged(hall, truth);
  EXPECT_FALSE(wrong.is_right);
  EXPECT_NEAR(wrong.right_share, 199.0 / 200.0, 1e-12);
  EXPECT_EQ(wrong.greatest_ppm, 11.0);
}

TEST(CompareWithTruth, WhatRefutesCleanAirHasToBeThere) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean));
  hall.Set({4, 4}, 30.0F, 1.0F);
  Scene truth = Truth(hall);
  truth.conc_mean_ppm[Cell{9, 9}] = 11.0F;  // elsewhere
  EXPECT_FALSE(Judged(hall, truth).is_right);
  truth.conc_mean_ppm[Cell{4, 4}] = 11.0F;
  EXPECT_TRUE(Judged(hall, truth).is_right);
}

TEST(CompareWithTruth, TheStrongestPlaceIsNearTheTrueOneOrNot) {
  MeasuredHall hall(Objective(ObjectiveKind::kFindSources));
  hall.Set({10, 5}, 50.0F, 9.0F);
  Scene truth = Truth(hall);
  truth.conc_mean_ppm[Cell{12, 5}] = 60.0F;  // a metre away
  EXPECT_TRUE(Judged(hall, truth).is_right);
  truth.conc_mean_ppm[Cell{15, 5}] = 61.0F;
  EXPECT_FALSE(Judged(hall, truth).is_right);
}

TEST(CompareWithTruth, WhatIsNotConcludedIsNotRight) {
  MeasuredHall hall(Objective(ObjectiveKind::kMapAboveThreshold, 0.0));
  const Scene truth = Truth(hall);
  EXPECT_TRUE(Judged(hall, truth).is_right);
  hall.Forget({3, 3});
  EXPECT_FALSE(Judged(hall, truth).is_right);
}

}  // namespace objective_truth_test
}  // namespace plumescout::lab
