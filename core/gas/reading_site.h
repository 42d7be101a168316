// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/gas/anchor_cell.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"

namespace plumescout {

// All that placing needs to know of where a reading was taken: its cell, and the order in which
// the eight neighbours come into question. Readings of the same site always share a cell of the
// field, so they can be merged and yet be placed by their position. A cell holds kSitesPerCell at
// most: the order is the same throughout each eighth of it, between an axis and a diagonal through
// its centre, and on some of those lines, where two neighbours are equally near, it is another.
struct ReadingSite {
  AnchorCell cell;
  std::uint32_t neighbour_order = 0;  // 3 bits a neighbour, the first lowest

  friend auto operator<=>(const ReadingSite&, const ReadingSite&) = default;
};

inline constexpr std::size_t kSitesPerCell = 8 + 5;

// REQUIRES: finite position.
ReadingSite SiteOf(Point2 position, const GridGeometry& anchor);

// The site of a reading in the middle of its cell.
ReadingSite CentreOf(AnchorCell cell);

struct Placement {
  std::optional<AnchorCell> cell;  // none: the site has to wait
  bool moved = false;              // to a neighbour

  friend bool operator==(const Placement&, const Placement&) = default;
};

// The site's own cell if it is free in `states`, whose cell (0, 0) is `corner`; else the free
// neighbour across a side whose centre is nearest, of equal ones the first in the order E, N, W, S;
// else the one across a corner, NE, NW, SW, SE. Sides come first because the field is linked
// across them alone: what lies across a corner may be another room.
Placement PlacementOf(const ReadingSite& site, const Grid<CellState>& states, AnchorCell corner);

}  // namespace plumescout
