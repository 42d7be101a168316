// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/plan/cost/information_map.h"
#include "core/types/grid.h"
#include "core/types/options.h"
#include "core/types/rng.h"
#include "core/types/stop.h"

namespace plumescout {

// Sampling mass q of [XIT] Eq. (14): (1 - eps) * I-hat / sum(I-hat) + eps / cells, with eps =
// `uniform_share`. It sums to 1 over the cells marked in `domain` without the robot's own cell and
// is 0 elsewhere. If all information is in the robot's cell the mass is uniform. Of no use once
// `stop`, which is asked all along, says so: it may have no cells. Cost: O(cells).
Grid<float> SamplingMass(const InformationMap& information, const Grid<std::uint8_t>& domain,
                         Cell robot_cell, double uniform_share, const StopFn& stop = {});

// InformedSample of [XIT] Alg. 1 line 1: min(count, cells with mass) different cells.
//   kIid         drawn one after the other without replacement, each by the mass that is left
//                (the paper).
//   kSystematic  ours: one random offset, then equal steps of mass along a Hilbert curve, so that
//                every compact region gets its share of samples give or take one. A cell is drawn
//                with probability min(1, c q), the same c for all.
// In the order of the raster (kIid) or of the curve. Fewer once `stop`, which is asked all along,
// says so. Cost: O(cells).
std::vector<Cell> DrawSamples(const Grid<float>& mass, int count, SamplingKind kind, Rng& rng,
                              const StopFn& stop = {});

}  // namespace plumescout
