// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>

#include "core/gas/gmrf_graph.h"
#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"

namespace plumescout {

// All that placing needs to know of where a reading was taken: its cell, counted from the corner of
// a fixed anchor lattice, and the order in which the eight neighbours lie near it. Readings of the
// same site always share a variable, so they can be merged and yet be placed by their position.
struct ReadingSite {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::uint32_t neighbour_order = 0;  // 3 bits a neighbour, the nearest lowest

  friend auto operator<=>(const ReadingSite&, const ReadingSite&) = default;
};

// REQUIRES: finite position.
ReadingSite SiteOf(Point2 position, const GridGeometry& anchor);

struct Placement {
  VariableIndex variable = VariableIndex::kNone;  // kNone: the site has to wait
  bool moved = false;                             // to a neighbour
};

// The variable of the site's own cell, else of the free neighbour whose centre is nearest; of equal
// ones the first in the order E, N, W, S, NE, NW, SW, SE. (`shift_x`, `shift_y`) is the cell of
// `graph` in which the anchor's cell (0, 0) lies.
Placement Place(const ReadingSite& site, std::int64_t shift_x, std::int64_t shift_y,
                const GmrfGraph& graph);

}  // namespace plumescout
