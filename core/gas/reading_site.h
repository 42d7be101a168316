// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include "core/gas/anchor_cell.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"

namespace plumescout {

// All that placing needs to know of where a reading was taken: its cell, and the order in which
// the eight neighbours lie near it. Readings of the same site always share a cell of the field, so
// they can be merged and yet be placed by their position.
struct ReadingSite {
  AnchorCell cell;
  std::uint32_t neighbour_order = 0;  // 3 bits a neighbour, the nearest lowest

  friend auto operator<=>(const ReadingSite&, const ReadingSite&) = default;
};

// REQUIRES: finite position.
ReadingSite SiteOf(Point2 position, const GridGeometry& anchor);

// The site of a reading in the middle of its cell.
ReadingSite CentreOf(AnchorCell cell);

struct Placement {
  std::optional<AnchorCell> cell;  // none: the site has to wait
  bool moved = false;              // to a neighbour

  friend bool operator==(const Placement&, const Placement&) = default;
};

// The site's own cell if it is free in `states`, whose cell (0, 0) is `corner`, else the free
// neighbour whose centre is nearest; of equal ones the first in the order E, N, W, S, NE, NW, SW,
// SE.
Placement PlacementOf(const ReadingSite& site, const Grid<CellState>& states, AnchorCell corner);

}  // namespace plumescout
