// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/grid.h"
#include "lab/sim/advection_diffusion.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/mac_field.h"
#include "lab/sim/wind.h"

namespace plumescout::lab {

// What gas does where.
struct PlumeCase {
  LayoutRaster raster;
  MacField wind;
  std::vector<GasSource> sources;
  GasParameters gas;
};

// Filaments so far, over all sources.
struct MassPoint {
  double time_s = 0.0;
  std::int64_t released = 0;
  std::int64_t inside = 0;
  std::int64_t left = 0;
};

struct PlumeMean {
  Grid<float> ppm;               // mean of the slices, all sources together
  std::vector<MassPoint> mass;   // at 2 Hz, warm-up included
  double times_real_time = 0.0;  // simulated time over processor time, slices included
};

PlumeMean MeanOfFilaments(const PlumeCase& gas_case, const MeanWindow& window, std::uint64_t seed,
                          const FractionFn& progress);

}  // namespace plumescout::lab
