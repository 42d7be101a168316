// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/types/cell_state.h"
#include "core/types/objective.h"

namespace plumescout {

// Where and when gas was measured last around a place.
struct NearestReading {
  double distance_m = 0.0;              // to the middle of the cell in which it was taken
  std::optional<std::int64_t> time_ns;  // none: taken before times were kept

  friend bool operator==(const NearestReading&, const NearestReading&) = default;
};

// What a belief says of the gas at one place: that of its cell, for the field has no finer detail.
struct GasAtPlace {
  std::optional<CellState> state;  // none: off the map
  // Only of free cells, and once the posterior knows them.
  std::optional<double> mean_ppm;
  std::optional<double> variance_ppm2;
  bool observed = false;  // the variance is below that which gas frontiers count as observed
  std::optional<NearestReading> nearest_reading = std::nullopt;  // none: no reading yet
  // How the objective stands there; none: nobody asked, there is no objective, or it is off the
  // map.
  std::optional<ObjectiveVerdict> verdict = std::nullopt;
};

}  // namespace plumescout
