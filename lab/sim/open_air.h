// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/grid_geometry.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

// A place without walls: all cells are free, gas leaves at the raster's edge. For checks against
// what is known of plumes in the open.
LayoutRaster OpenAir(const GridGeometry& geometry);

// The same wind everywhere.
MacField UniformWind(const GridGeometry& geometry, Velocity velocity);

}  // namespace plumescout::lab
