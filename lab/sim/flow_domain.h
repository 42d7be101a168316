// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/grid.h"
#include "formats/scene.h"

namespace plumescout::lab {

// Outer face of a fluid cell on the edge of the raster: where air enters or leaves the building.
struct BoundaryFace {
  Cell cell;
  Side side = Side::kWest;           // of the raster, and of `cell`
  std::optional<double> inflow_mps;  // into the building; without it: outlet, ambient pressure
};

// Where air can flow. Faces between fluid and solid cells, and outer faces that `openings` does not
// list, are walls. If there are faces, every fluid cell is connected to an outlet.
struct FlowDomain {
  Grid<std::uint8_t> fluid;  // 1: air, 0: solid
  std::vector<BoundaryFace> openings;
};

}  // namespace plumescout::lab
