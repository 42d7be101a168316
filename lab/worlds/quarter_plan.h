// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"

namespace plumescout::lab {

// Ellipse in frame map, its axes along those of the frame.
struct BuiltUpArea {
  Point2 center;
  double half_width_m = 0.0;   // along x
  double half_height_m = 0.0;  // along y

  bool Holds(Point2 point) const;
};

// A town quarter in open country, of the size of [IPP] section IV: 68 x 74 cells of 13 m. Blocks of
// buildings stand in rows, with streets of one or two cells between them, one wider road through
// the middle, and here and there a square. The free cells hang together.
struct QuarterPlan {
  Grid<CellState> occupancy;
  BuiltUpArea built_up;
};

// The same seed, the same quarter.
QuarterPlan MakeQuarterPlan(std::uint64_t seed);

}  // namespace plumescout::lab
