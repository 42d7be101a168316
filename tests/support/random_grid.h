// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/grid.h"
#include "core/types/rng.h"

namespace plumescout::testing {

// Each cell 1 with probability `share`, else 0.
inline Grid<std::uint8_t> RandomMask(int width, int height, double share, Rng& rng) {
  GridGeometry geometry;
  geometry.width = width;
  geometry.height = height;
  Grid<std::uint8_t> mask(geometry);
  for (std::uint8_t& value : mask.values()) value = rng.Uniform01() < share ? 1 : 0;
  return mask;
}

inline Cell RandomCell(const GridGeometry& geometry, Rng& rng) {
  return geometry.CellAtIndex(rng.Below(geometry.size()));
}

}  // namespace plumescout::testing
