// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "proto/convert/raster.h"

namespace plumescout::server {

// A coarser raster: squares of 2^level by 2^level cells, counted from cell (0, 0). Those along the
// upper and the right border hold the cells that there are.
GridGeometry SquaresOf(const GridGeometry& cells, int level);

// The cells of some squares.
CellRect CellsOf(const CellRect& squares, int level, const GridGeometry& cells);

// Some squares of such a raster: the worst of their cells (occupied, unknown, free), or the largest
// (NaN if there is none). REQUIRES: the squares lie in the raster.
Grid<CellState> WorstStates(const Grid<CellState>& cells, int level, const CellRect& squares);
Grid<float> LargestValues(const Grid<float>& cells, int level, const CellRect& squares);

}  // namespace plumescout::server
