// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lab/report/map_panel.h"
#include "lab/sim/flow_domain.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

struct FlowPicture {
  std::string title;
  Rectangle region;                   // shown, of the domain
  double fastest_mps = 1.0;           // speed of the last colour
  std::vector<double> stream_values;  // of the stream lines to draw, see StreamFunction
};

// Flow between a corner of cells and the raster's south-west corner, m^2/s: width + 1 values per
// row of corners, from the south. Stream lines are its contours: exact where the field is
// divergence-free, so lines close where eddies do.
std::vector<double> StreamFunction(const MacField& velocity);

// Speed as colour, walls grey, stream lines white.
MapPanel DrawFlow(const FlowDomain& domain, const MacField& velocity, const FlowPicture& picture);

}  // namespace plumescout::lab
