// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "lab/sim/flow_domain.h"
#include "lab/sim/layout.h"

namespace plumescout::lab {

// A layout on its grid. The map is closed: cells of openings are fluid, but occupied in it.
struct LayoutRaster {
  Grid<CellState> occupancy;  // free or occupied, never unknown; the free cells are 4-connected
  FlowDomain flow;
};

// A cell is solid if its centre is. Free cells that no way leads to from the start become occupied.
// Errors, kInvalidArgument: Validate's; the start or a source not in the open; an opening that
// leads into a wall or overlaps another; inlets without an outlet; openings without an inlet,
// unless fans move the air; those of AddFans.
absl::StatusOr<LayoutRaster> Rasterize(const Layout& layout);

}  // namespace plumescout::lab
