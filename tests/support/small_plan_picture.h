// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/report/plan_panels.h"

namespace plumescout {

// A planning step in a room of 40 x 30 cells of 0.2 m: two candidates, of which the second is
// chosen, one rejected goal and a tree of three edges.
inline lab::PlanPicture MakeSmallPlanPicture() {
  const GridGeometry geometry{0.0, 0.0, 0.2, 40, 30};
  lab::PlanPicture picture;
  picture.title = "Plan of scout";
  picture.occupancy = Grid<CellState>(geometry, CellState::kFree);
  picture.information = Grid<float>(geometry, 0.5F);
  for (int x = 0; x < geometry.width; ++x) picture.occupancy[Cell{x, 0}] = CellState::kOccupied;
  picture.robot = {2.0, 2.0, 0.0};
  picture.tree = {
      {{{2.0, 2.0}, {4.0, 2.0}}}, {{{4.0, 2.0}, {6.0, 3.0}}}, {{{2.0, 2.0}, {2.0, 5.0}}}};
  Candidate gas;
  gas.goal.kind = GoalKind::kGasFrontier;
  gas.goal.position = {6.0, 3.0};
  gas.path = {{2.0, 2.0}, {4.0, 2.0}, {6.0, 3.0}};
  gas.expected_information_nats = 1.5;
  Candidate frontier;
  frontier.goal.position = {2.0, 5.0};
  frontier.path = {{2.0, 2.0}, {2.0, 5.0}};
  picture.plan.candidates = {gas, frontier};
  picture.plan.chosen = 1;
  picture.plan.explanation = "Drive to a frontier.";
  RejectedGoal rejected;
  rejected.goal.position = {7.0, 5.0};
  rejected.reason = RejectionReason::kTooSmall;
  picture.plan.rejected = {rejected};
  return picture;
}

}  // namespace plumescout
