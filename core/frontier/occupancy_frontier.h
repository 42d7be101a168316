// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/frontier/goal_cells.h"
#include "core/types/cell_state.h"
#include "core/types/frontier.h"
#include "core/types/grid.h"
#include "core/types/stop.h"

namespace plumescout {

// Wavefront frontier detection [WFD]. A frontier cell is an unknown cell with a free 8-neighbour
// that is reachable: connected (8-neighbours, through free cells, no corner cut) to a start cell,
// or to the free cell nearest to a start that is not free. Clusters are 8-connected; those of
// fewer than `min_cells` cells are marked too_small. Goal cells: core/frontier/goal_cells.h.
//
// REQUIRES: both rasters share one geometry. Cost: O(cells). Deterministic.
std::vector<Frontier> FindOccupancyFrontiers(const Grid<CellState>& states,
                                             const Grid<std::uint8_t>& traversable,
                                             const std::vector<Cell>& starts, int min_cells);
// The same from one start, by ways from it that are known; of no use once `stop` says so, which is
// asked all along. REQUIRES: `from_start` has run, over CellsAroundFree.
std::vector<Frontier> FindOccupancyFrontiers(const Grid<CellState>& states, Cell start,
                                             const TravelFromStarts& from_start, int min_cells,
                                             const StopFn& stop = {});

}  // namespace plumescout
