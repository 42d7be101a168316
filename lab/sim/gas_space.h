// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/grid.h"
#include "lab/sim/layout_raster.h"

namespace plumescout::lab {

// What a cell is to gas. Cells of openings, and all beyond the raster, are outside: gas that
// reaches them has left.
enum class GasSpace : std::uint8_t { kInside, kOutside, kSolid };

Grid<GasSpace> GasSpaces(const LayoutRaster& raster);

// Distance to the nearest solid cell in steps to one of the eight neighbours, 0 on solid cells, at
// most 255. A way shorter than that on either axis is clear, whatever its direction.
Grid<std::uint8_t> Clearances(const Grid<GasSpace>& spaces);

}  // namespace plumescout::lab
