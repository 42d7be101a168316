// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plan/paths/path_planner.h"

namespace plumescout {

// Ours: finds a path to every goal of `result` that has none yet, so that a goal which can be
// reached on the grid is reached: an exact 8-connected search (no corner cut) from the start under
// the problem's cost, then Straighten. The paths are marked as `source`.
// Under CostKind::kVertices every cell is a vertex, so that they are dearer than a tree's.
// Ends as kAllGoalsReached, kQueueExhausted if a goal has no traversable way, or kStopped.
// The edge budget does not bound the search: call it only when the tree search ended by itself.
//
// Cost: O(cells cheaper to reach than the dearest missed goal); nothing if no goal is missed.
void CompleteOnGrid(const PathProblem& problem, PathSource source, PathResult& result);

}  // namespace plumescout
