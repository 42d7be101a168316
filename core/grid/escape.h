// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"

namespace plumescout {

// The way out of the inflated zone: the cells from `start` to the nearest traversable cell, both
// included, by 8-connected steps that cut no corner. It leads through free cells; if `start` is
// not free itself (a robot on a cell not seen yet, or hit by noise), through unknown ones too, but
// never through an occupied one other than `start`. {start} if it is traversable; empty if there is
// no way or `start` is outside.
// REQUIRES: both rasters share one geometry. Cost: O(cells).
std::vector<Cell> EscapePath(const Grid<CellState>& states, const Grid<std::uint8_t>& traversable,
                             Cell start);

}  // namespace plumescout
