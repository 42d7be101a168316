// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>

#include "absl/status/statusor.h"
#include "core/types/cell_rect.h"
#include "core/types/grid_geometry.h"

namespace plumescout {

// Cell of a map that grows, counted from the corner of its first grid, the anchor: while the index
// of a place changes with every growth, its anchor cell stays. Ordered row by row from the south,
// as grids are stored.
struct AnchorCell {
  int x = 0;
  int y = 0;

  friend bool operator==(const AnchorCell&, const AnchorCell&) = default;
  friend std::strong_ordering operator<=>(const AnchorCell& a, const AnchorCell& b) {
    return a.y != b.y ? a.y <=> b.y : a.x <=> b.x;
  }
};

// The anchor cell of cell (0, 0) of `geometry`. Errors: kInvalidArgument for a lattice of another
// resolution, between the anchor's cells, or more than 2^29 cells away.
absl::StatusOr<AnchorCell> CornerOf(const GridGeometry& geometry, const GridGeometry& anchor);

using AnchorRect = CellRectOf<AnchorCell>;

}  // namespace plumescout
