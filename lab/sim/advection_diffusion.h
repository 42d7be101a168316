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
//   div(u C - D grad C) + (rate + max(0, -div u)) C = source,   D = K + gamma / 2
//
// on the cells that gas fills, by finite volumes: the wind's own faces; upwind-biased advection of
// second order (Fromm's scheme: first-order upwinding would spread gas by u h / 2, several times
// D); nothing through walls; outside, C = 0. Sources are as wide as fresh filaments. The growing
// depth that gas is diluted over is a sum of decays (InverseDepthTerms): the equation is solved
// once for each, with its `rate`. Clipped at 0: before sharp fronts the scheme undershoots a
// little.
//
// In a wind that flows together, as a slice of a flow in space may, the air that leaves upwards
// takes gas along, and what comes from above where the wind parts is clean. SolveWind's never does.
//
// Schedules of the sources are not looked at. One layer per source, ppm; 0 but in free cells.
//
// Errors: kFailedPrecondition if gas cannot get out anywhere. Cost: some 0.2 s per term for 28,000
// cells. REQUIRES: all of one layout, which is valid; `wind` is finite.
absl::StatusOr<std::vector<Grid<float>>> SteadyConcentration(const LayoutRaster& raster,
                                                             const MacField& wind,
                                                             const std::vector<GasSource>& sources,
                                                             const GasParameters& gas);

// From the beginning of the release on.
struct MeanWindow {
  double warm_up_s = 180.0;  // before the mean, [0, 100000]
  double mean_s = 300.0;     // (0, 100000], without its beginning, with its end
};

// The same for a release that began a while ago, as a mean over a window of time: rooms without a
// draught take hours to fill. In implicit steps of kMeanStep_s (Euler: stable at any length, and
// what changes faster is steady). Gas need not get out. Errors: kInvalidArgument for a window out
// of range. Cost: besides, a solution per step.
inline constexpr double kMeanStep_s = 5.0;
absl::StatusOr<std::vector<Grid<float>>> MeanConcentration(const LayoutRaster& raster,
                                                           const MacField& wind,
                                                           const std::vector<GasSource>& sources,
                                                           const GasParameters& gas,
                                                           const MeanWindow& window);

}  // namespace plumescout::lab
