// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/types/grid.h"
#include "lab/sim/layout.h"
#include "lab/sim/layout_raster.h"
#include "lab/sim/mac_field.h"

namespace plumescout::lab {

// The concentration that release without end leads to, without filaments: the check on Plume.
//
//   div(u C - D grad C) + (rate + exchange) C = source,   D = K + gamma / 2
//
// on the cells that gas fills, by finite volumes: the wind's own faces; upwind-biased advection of
// second order (Fromm's scheme: first-order upwinding would spread gas by u h / 2, several times
// D); nothing through walls; outside, C = 0. Sources are as wide as fresh filaments. The growing
// depth that gas is diluted over is a sum of decays (InverseDepthTerms): the equation is solved
// once for each, with its `rate`. Clipped at 0: before sharp fronts the scheme undershoots a
// little.
//
// `air_exchange_per_s` takes gas out of every cell alike, as openings above the slice do.
// Schedules of the sources are not looked at. One layer per source, ppm; 0 but in free cells.
//
// Errors: kFailedPrecondition if gas cannot get out: neither an outside nor an exchange of air.
// kInvalidArgument if the exchange is negative or not finite. Cost: some 0.5 s per term for 28,000
// cells. REQUIRES: all of one layout, which is valid; `wind` has no net flow into any fluid cell.
absl::StatusOr<std::vector<Grid<float>>> SteadyConcentration(const LayoutRaster& raster,
                                                             const MacField& wind,
                                                             const std::vector<GasSource>& sources,
                                                             const GasParameters& gas,
                                                             double air_exchange_per_s = 0.0);

}  // namespace plumescout::lab
