// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/grid.h"
#include "core/types/polygon.h"

namespace plumescout {

// Sets to 0 the cells whose centre lies in one of the areas; a centre on the boundary counts to its
// east and north. REQUIRES: every area has a vertex, finite ones. Cost: O(rows * vertices + cells
// inside) an area.
void CloseKeptOut(const std::vector<Polygon>& areas, Grid<std::uint8_t>& traversable);

// 1 in those cells, else 0.
Grid<std::uint8_t> KeptOutCells(const std::vector<Polygon>& areas, const GridGeometry& geometry);

}  // namespace plumescout
