// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/cell.h"
#include "core/types/pose2.h"

namespace plumescout {

enum class FrontierKind { kOccupancy, kGas };

// One cluster of frontier cells, [XIT] Eq. (22) for gas; 8-connected unknown cells for occupancy.
struct Frontier {
  FrontierKind kind = FrontierKind::kOccupancy;
  std::vector<Cell> cells;  // in the order the wavefront met them
  Point2 centroid;          // mean of the cell centres; often not traversable: a label, not a goal
  Cell goal_cell;           // the reachable traversable cell nearest to the centroid by travel,
                            // defined in core/frontier/goal_cells.h
  // Metres from the start cells to goal_cell along the 8-connected grid; frontiers that no start
  // can reach are kept, with `reachable` false and goal_cell meaningless.
  double travel_m = 0.0;
  bool reachable = false;
  bool too_small = false;  // fewer cells than the minimum: kept for the record, not a goal
};

}  // namespace plumescout
