// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/open_air.h"

#include "core/types/cell_state.h"

namespace plumescout::lab {

LayoutRaster OpenAir(const GridGeometry& geometry) {
  LayoutRaster raster;
  raster.occupancy = Grid<CellState>(geometry, CellState::kFree);
  raster.flow.fluid = Grid<std::uint8_t>(geometry, 1);
  return raster;
}

MacField UniformWind(const GridGeometry& geometry, Velocity velocity) {
  MacField wind(geometry);
  for (int y = 0; y <= geometry.height; ++y) {
    for (int x = 0; x <= geometry.width; ++x) {
      if (y < geometry.height) wind.u(x, y) = velocity.u_mps;
      if (x < geometry.width) wind.v(x, y) = velocity.v_mps;
    }
  }
  return wind;
}

}  // namespace plumescout::lab
