// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/belief/objective_assessment.h"

#include <gtest/gtest.h>

#include "tests/support/measured_hall.h"

namespace plumescout {
namespace objective_assessment_test {

using support::MeasuredHall;
using support::Objective;

TEST(AssessObjective, CleanAirIsConfirmedByItsWorstCell) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean));
  hall.Set({7, 7}, 6.0F, 4.0F);
  const ObjectiveStatus status = AssessObjective(hall.belief);
  EXPECT_EQ(status.state, ObjectiveState::kMet);
  EXPECT_EQ(status.place, hall.Center({7, 7}));
  EXPECT_NEAR(status.confidence, 0.97725, 1e-5);
  EXPECT_EQ(status.undecided_area_m2, 0.0);
  EXPECT_FLOAT_EQ(static_cast<float>(status.mean_ppm), 6.0F);
  EXPECT_FLOAT_EQ(static_cast<float>(status.stddev_ppm), 2.0F);
}

TEST(AssessObjective, OneDoubtfulCellIsEnoughToGoOn) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean));
  hall.Set({7, 7}, 8.0F, 4.0F);
  const ObjectiveStatus status = AssessObjective(hall.belief);
  EXPECT_EQ(status.state, ObjectiveState::kPursued);
  EXPECT_NEAR(status.undecided_area_m2, 0.25, 1e-9);
  EXPECT_NEAR(status.confidence, 0.841345, 1e-5);
}

TEST(AssessObjective, OneSurelyUncleanCellRefutesWhateverElseIsOpen) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean, 0.0));
  hall.Set({7, 7}, 14.0F, 4.0F);
  hall.Forget({3, 3});
  const ObjectiveStatus status = AssessObjective(hall.belief);
  EXPECT_EQ(status.state, ObjectiveState::kRefuted);
  EXPECT_EQ(status.place, hall.Center({7, 7}));
  EXPECT_NEAR(status.confidence, 0.97725, 1e-5);
}

TEST(AssessObjective, WhereNobodyMeasuredThereIsNoConfidence) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean, 0.0));
  hall.Forget({3, 3});
  const ObjectiveStatus status = AssessObjective(hall.belief);
  EXPECT_EQ(status.state, ObjectiveState::kPursued);
  EXPECT_EQ(status.confidence, 0.0);
  EXPECT_EQ(status.place, hall.Center({3, 3}));
}

TEST(AssessObjective, OpenFrontiersKeepItOpenUntilTheyAreGivenUp) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean));
  (*hall.occupancy)[Cell{21, 5}] = CellState::kUnknown;
  const ObjectiveStatus open = AssessObjective(hall.belief);
  EXPECT_EQ(open.state, ObjectiveState::kPursued);
  EXPECT_EQ(open.open_frontiers, 1);
  Goal goal;
  goal.kind = GoalKind::kOccupancyFrontier;
  goal.position = hall.Center({20, 5});
  hall.belief.set_aside.push_back({goal, "visited without change", 1});
  EXPECT_EQ(AssessObjective(hall.belief).state, ObjectiveState::kMet);
}

TEST(AssessObjective, WhatNoRobotCanReachDoesNotCount) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean));
  for (int y = 1; y <= 10; ++y) {
    (*hall.occupancy)[Cell{15, y}] = CellState::kOccupied;
    (*hall.traversable)[Cell{15, y}] = 0;
  }
  hall.Set({18, 5}, 100.0F, 1.0F);
  EXPECT_EQ(AssessObjective(hall.belief).state, ObjectiveState::kMet);
  hall.belief.robots["far"].first_place = hall.Center({17, 5});
  EXPECT_EQ(AssessObjective(hall.belief).state, ObjectiveState::kRefuted);
  (*hall.traversable)[Cell{16, 5}] = 0;  // too near to a wall for a plan that goes on
  hall.belief.robots["far"].first_place = hall.Center({16, 5});
  EXPECT_EQ(AssessObjective(hall.belief).state, ObjectiveState::kRefuted);
}

TEST(AssessObjective, WithoutAReadingNothingIsMet) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean));
  hall.belief.gas_counters.readings = 0;
  EXPECT_EQ(AssessObjective(hall.belief).state, ObjectiveState::kPursued);
}

TEST(AssessObjective, WithoutAReachableCellNothingIsKnown) {
  MeasuredHall hall(Objective(ObjectiveKind::kConfirmClean));
  hall.belief.robots.clear();
  const ObjectiveStatus status = AssessObjective(hall.belief);
  EXPECT_EQ(status.state, ObjectiveState::kPursued);
  EXPECT_FALSE(status.place.has_value());
}

TEST(AssessObjective, SourcesAreFoundOrThereIsNone) {
  MeasuredHall hall(Objective(ObjectiveKind::kFindSources));
  EXPECT_EQ(AssessObjective(hall.belief).state, ObjectiveState::kRefuted);
  hall.Set({10, 5}, 50.0F, 9.0F);
  const ObjectiveStatus found = AssessObjective(hall.belief);
  EXPECT_EQ(found.state, ObjectiveState::kMet);
  EXPECT_EQ(found.strongest, hall.Center({10, 5}));
  hall.Set({15, 5}, 49.0F, 9.0F);
  EXPECT_EQ(AssessObjective(hall.belief).state, ObjectiveState::kPursued);
}

TEST(AssessObjective, PlumesAreMappedOnceTheirEdgesAreKnown) {
  MeasuredHall hall(Objective(ObjectiveKind::kMapAboveThreshold));
  hall.Set({10, 5}, 50.0F, 9.0F);
  hall.Set({11, 5}, 10.0F, 9.0F);
  EXPECT_EQ(AssessObjective(hall.belief).state, ObjectiveState::kMet);
}

}  // namespace objective_assessment_test
}  // namespace plumescout
