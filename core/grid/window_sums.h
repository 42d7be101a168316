// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/grid.h"
#include "core/types/stop.h"

namespace plumescout {

// For each cell the sum of the values within `reach_cells` (>= 0) of it along both axes, which is a
// square of 2 reach_cells + 1; cells beyond the raster's edge count as 0. Of no use once `stop`,
// which is asked all along, says so. REQUIRES: finite values. Cost: O(cells), whatever the reach.
Grid<float> WindowSums(const Grid<float>& values, int reach_cells, const StopFn& stop = {});

}  // namespace plumescout
