// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/grid.h"

namespace plumescout {

// Stands for "no set cell" and "beyond the cap": larger than any squared distance on a raster.
inline constexpr std::int32_t kFarSquared = INT32_MAX;

// Exact squared Euclidean distance, in cells, from each cell's centre to that of the nearest
// non-zero cell of `set`; kFarSquared if there is none.
// REQUIRES: width and height below 2^15.Cost: O(cells) (Meijster, Roerdink and Hesselink 2000).
Grid<std::int32_t> SquaredDistances_cells2(const Grid<std::uint8_t>& set);

// The same up to `cap_cells`, kFarSquared beyond. Faster for small caps.
// REQUIRES: 0 <= cap_cells < 2^15. Cost: O(cells * cap_cells) in vectorised steps.
Grid<std::int32_t> SquaredDistancesUpTo_cells2(const Grid<std::uint8_t>& set, int cap_cells);

}  // namespace plumescout
