// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "absl/status/status.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/options.h"

namespace plumescout {

// Cell (0,0) of `geometry` on the lattice of a mission with `resolution_m`, counted from (0,0) of
// frame map.
// REQUIRES: the origin lies on the lattice, as ValidatePriorMap checks.
Cell LatticeCell(const GridGeometry& geometry, double resolution_m);

// OK if a mission with `options` can start with `map`: the same lattice, room for it in whole
// tiles, and a free cell. Otherwise kInvalidArgument that begins with "prior_map" and names what is
// wrong with its value. Cost: O(cells) at worst.
absl::Status ValidatePriorMap(const Grid<CellState>& map, const OccupancyOptions& options);

// Has missions with `options` start with `map`: its resolution becomes theirs, and limits of
// extent, cells and poses that it exceeds are raised to hold it (Validate may find them too high).
void StartWith(std::shared_ptr<const Grid<CellState>> map, MissionOptions& options);

}  // namespace plumescout
