// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
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

// Whether the place lies in one of the areas; REQUIRES and boundaries as above.
bool IsKeptOut(const std::vector<Polygon>& areas, Point2 place);

// The first cell at which the way enters an area that it does not begin in; else, if it ends in
// one, the cell that it ends in: a way may lead out of an area, but not stay there. `kept_out`: of
// KeptOutCells.
std::optional<Cell> FirstKeptOut(const Grid<std::uint8_t>& kept_out,
                                 const std::vector<Point2>& way);

}  // namespace plumescout
