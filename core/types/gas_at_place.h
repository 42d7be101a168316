// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/types/cell_state.h"

namespace plumescout {

// What a belief says of the gas at one place: that of its cell, for the field has no finer detail.
struct GasAtPlace {
  std::optional<CellState> state;  // none: off the map
  // Only of free cells, and once the posterior knows them.
  std::optional<double> mean_ppm;
  std::optional<double> variance_ppm2;
  bool observed = false;  // the variance is below that which gas frontiers count as observed
};

}  // namespace plumescout
