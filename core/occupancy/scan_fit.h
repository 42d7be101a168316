// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/occupancy/occupancy_grid.h"
#include "core/occupancy/scan_inserter.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout {

// How a scan and a map that does not hold it yet agree, in beams.
struct ScanFit {
  int fitting = 0;   // end beside an occupied cell, and came there through none
  int short_of = 0;  // end where all cells within 0.2 m are free
  int beyond = 0;    // came through a wall, and on for 0.3 m

  int judged() const { return fitting + short_of + beyond; }
  friend bool operator==(const ScanFit&, const ScanFit&) = default;
};

// Of beams that return and do not end in a mask disc; those that end in the unknown tell nothing.
// At most kMostJudgedBeams, evenly chosen. A wall is an occupied cell with occupied ones on both
// sides across the beam: along a wall beams touch cells of it all the time.
// REQUIRES: finite pose, angles and max_range_m. Cost: O(cells crossed).
inline constexpr int kMostJudgedBeams = 180;
ScanFit FitOf(const Pose2& sensor_pose, const Scan& scan, const std::vector<MaskDisc>& masks,
              const OccupancyGrid& grid);

}  // namespace plumescout
