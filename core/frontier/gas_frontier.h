// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/frontier.h"
#include "core/types/grid.h"
#include "core/types/options.h"

namespace plumescout {

// What gas frontiers are found from, all on one geometry.
struct GasFrontierInput {
  const Grid<CellState>& states;
  const Grid<std::uint8_t>& traversable;
  const Grid<float>& mean_ppm;        // NaN where not free or not yet computed
  const Grid<float>& variance_ppm2;   // NaN likewise
};

// Variance at or below which a cell counts as observed, ppm^2.
double ObservedVariance_ppm2(const FrontierOptions& options, const GasOptions& gas);

// tau_gas of [XIT] Eq. (17): the percentile of the mean over observed free cells, at least
// min_gas_threshold_ppm; or the fixed threshold.
double GasThreshold_ppm(const GasFrontierInput& input, double observed_variance_ppm2,
                        const FrontierOptions& options);

// Wavefront gas frontier detection, [XIT] Alg. 2 and 3, Eq. (16)-(22), neighbourhood 8.
// Scope kLocal searches the critical component under each start (Alg. 2 to the letter for one
// start); kReachable every critical component that a start can reach over free cells.
// Cost: O(cells). Deterministic.
std::vector<Frontier> FindGasFrontiers(const GasFrontierInput& input, double observed_variance_ppm2,
                                       double gas_threshold_ppm, const std::vector<Cell>& starts,
                                       const FrontierOptions& options);

}  // namespace plumescout
