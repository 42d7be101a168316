// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/frontier.h"
#include "core/types/grid.h"
#include "core/types/options.h"
#include "core/types/stop.h"

namespace plumescout {

// What gas frontiers are found from, all on one geometry. A free cell without a variance (not yet
// computed) is not observed.
struct GasFrontierInput {
  const Grid<CellState>& states;
  const Grid<std::uint8_t>& traversable;
  const Grid<float>& mean_ppm;       // NaN where not free or not yet computed
  const Grid<float>& variance_ppm2;  // NaN likewise
};

// Variance at or below which a cell counts as observed, ppm^2: given, or a share of the variance
// on an open lattice. It depends on the precisions alone, not on the size of the map: the prior
// variance of a small room is so large that a share of it would call the whole room observed after
// one reading.
double ObservedVariance_ppm2(const FrontierOptions& options, const GasOptions& gas);

// tau_gas of [XIT] Eq. (17): the percentile q_p (linear between order statistics) of the mean over
// observed free cells, at least min_gas_threshold_ppm; or the fixed threshold.
// Of no use once `stop`, which is asked all along, says so.
double GasThreshold_ppm(const GasFrontierInput& input, double observed_variance_ppm2,
                        const FrontierOptions& options, const StopFn& stop = {});

// Wavefront gas frontier detection, [XIT] Alg. 2 and 3, Eq. (16)-(22), neighbourhood 8.
// Scope kLocal searches the critical component under each start (Alg. 2 to the letter for one
// start); kReachable (ours) every critical component that a start can reach over free cells,
// because [XIT] Fig. 5(c) resumes a frontier that Alg. 2 forgets when the robot leaves the gas.
// Clusters below the minimum size, which Alg. 2 line 22 discards, are kept and marked too_small.
// Goal cells: core/frontier/goal_cells.h; those of FindGasClusters are left open.
// Those are of no use once `stop`, which is asked all along, says so.
// Cost: O(cells). Deterministic.
std::vector<Frontier> FindGasClusters(const GasFrontierInput& input, double observed_variance_ppm2,
                                      double gas_threshold_ppm, const std::vector<Cell>& starts,
                                      const FrontierOptions& options, const StopFn& stop = {});
std::vector<Frontier> FindGasFrontiers(const GasFrontierInput& input, double observed_variance_ppm2,
                                       double gas_threshold_ppm, const std::vector<Cell>& starts,
                                       const FrontierOptions& options);

}  // namespace plumescout
