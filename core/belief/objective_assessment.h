// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/belief/belief.h"
#include "core/types/objective.h"

namespace plumescout {

// What the belief says of its mission's objective, of the cells that any robot can reach from where
// it is or began. The time since when is left 0, and whether the mission goes on is not looked at.
//
//   kConfirmClean       refuted as soon as one cell is above the threshold with the confidence
//   kFindSources        refuted if all cells are below it
//   otherwise           met once there are readings, no cell is undecided (see JudgeCells) and no
//                       frontier of the map is open
//
// A frontier is open if a robot can reach it, it is not too small, and goal memory has not set it
// aside: those keep no mission going either. The confidence is that of single cells: that all of
// many are right at once is less sure.
// REQUIRES: the objective is not kCompleteMap. Cost: O(cells).
ObjectiveStatus AssessObjective(const Belief& belief);

}  // namespace plumescout
