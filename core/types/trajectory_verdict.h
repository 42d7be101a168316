// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/types/cell.h"
#include "core/types/cell_state.h"
#include "core/types/plan.h"
#include "core/types/pose2.h"

namespace plumescout {

// Where a path cannot be driven.
struct Blockage {
  Cell cell;                       // the first such cell; may lie off the map
  Point2 position;                 // where the path meets it
  double distance_m = 0.0;         // from the path's first vertex
  std::optional<CellState> state;  // free: too near an obstacle, or kept out; none: off the map
};

// What has become of a path on a newer belief.
struct TrajectoryVerdict {
  std::optional<Blockage> blockage;       // the first; none: the way is still free
  std::optional<RejectedGoal> rejection;  // why the goal is not worth it any more; none: it is
  std::optional<Candidate> rest;          // the path with its price; none if it is blocked
};

}  // namespace plumescout
