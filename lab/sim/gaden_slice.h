// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/grid.h"
#include "lab/formats/gaden_environment.h"
#include "lab/formats/gaden_frame.h"

namespace plumescout::lab {

// Layer of cells that holds the height. REQUIRES: the environment does.
int LayerAt(const GadenEnvironment& environment, double height_m);

// Concentration over the centres of the cells at this height, ppm; 0 in cells that are not free.
// As GADEN 3 samples it: the sum over the filaments within three sigma that see the point, each a
// Gaussian; a frame of concentrations gives those of the layer. A filament sees a point if both
// lie in free cells and so do the places between them, a cell's length or somewhat more apart.
// Cost: a filament costs its disc of cells times the cells of a radius. REQUIRES: the frame is of
// this environment, and the environment has the height.
Grid<float> SliceGadenFrame(const GadenEnvironment& environment, const GadenFrame& frame,
                            double height_m);

}  // namespace plumescout::lab
