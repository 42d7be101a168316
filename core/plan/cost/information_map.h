// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/grid.h"
#include "core/types/options.h"
#include "core/types/stop.h"

namespace plumescout {

// What the information map is made from: rasters of one geometry, and the numbers of models.
struct InformationMapInput {
  const Grid<std::uint8_t>& traversable;
  const Grid<float>& mean_ppm;       // mu; NaN off free cells and where not yet computed
  const Grid<float>& variance_ppm2;  // epsilon; NaN likewise
  const GasOptions& gas;
  const FrontierOptions& frontier;
};

// Upper confidence bound over the traversable cells, [XIT] Eq. (8)-(11).
struct InformationMap {
  Grid<float> value;  // I-hat of Eq. (10), in [0, 1]; 0 where not traversable
  // P of Eq. (11), in [kMinPenalty, 1]; +infinity where not traversable, so that one walk along a
  // segment gives its price and finds collisions.
  Grid<float> penalty;
  float min_penalty = 1.0F;  // least penalty of a traversable cell
  bool flat = false;         // no contrast: I-hat = 0.5 everywhere, pure distance behaviour
};

// Ours: Eq. (11) gives 0 at the most informative cell, where a path could wander for nothing.
// [XIT] Eq. (4) asks for a strictly positive cost.
inline constexpr float kMinPenalty = 1e-3F;

// The map for variance weight options.beta. Differs from the paper where its formulas break:
//   Eq. (9)   max(0, mu) / max(max mu, tau_gas,min): posterior means may be 0 or less.
//   Eq. (8)   min(1, epsilon / epsilon_inf) in place of a raw variance in ppm^2, which would
//             outweigh the dimensionless mean; options.raw_variance takes it as printed.
//   Eq. (10)  I-hat = 0.5 and `flat` if I has no contrast.
// Cells known to be free since the last refresh of the posterior have no mean or variance yet:
// they take the prior, m_0 and epsilon_inf. Of no use once `stop`, which is asked all along, says
// so: it may have no cells. Cost: O(cells).
InformationMap MakeInformationMap(const InformationMapInput& input, const PlanningOptions& options,
                                  const StopFn& stop = {});

}  // namespace plumescout
