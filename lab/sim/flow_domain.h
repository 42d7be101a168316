// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/types/grid.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// Outer face of a fluid cell on the edge of the raster: where air enters or leaves the building.
struct BoundaryFace {
  Cell cell;
  Side side = Side::kWest;           // of the raster, and of `cell`
  std::optional<double> inflow_mps;  // into the building; without it: outlet, ambient pressure
};

// Face that a fan keeps at one speed. Two fluid cells meet there.
struct FanFace {
  Cell cell;
  Side side = Side::kWest;  // of `cell`: kWest or kSouth
  double speed_mps = 0.0;   // eastward through a west face, northward through a south face
};

// Where air can flow. Faces between fluid and solid cells, and outer faces that `openings` does not
// list, are walls.
struct FlowDomain {
  Grid<std::uint8_t> fluid;  // 1: air, 0: solid
  std::vector<BoundaryFace> openings;
  std::vector<FanFace> fans;
  // Speed at which the walls on the raster's edge slide along themselves, by Side: eastward on the
  // south and the north edge, northward on the others. Buildings have none that do.
  std::array<double, 4> edge_speeds_mps{};
};

}  // namespace plumescout::lab
