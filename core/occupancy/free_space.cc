// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/free_space.h"

#include <cmath>
#include <cstddef>

#include "core/grid/distance_field.h"
#include "core/grid/mask.h"

namespace plumescout {

Grid<std::uint8_t> TraversableCells(const Grid<CellState>& states, double inflation_radius_m) {
  // A radius of a whole number of cells must not lose that ring to rounding: 0.3 / 0.1 < 3.
  constexpr double kRounding_cells = 1e-9;
  const double radius_cells = inflation_radius_m / states.geometry().resolution_m + kRounding_cells;
  const auto radius_cells2 = static_cast<std::int32_t>(radius_cells * radius_cells);
  const Grid<std::int32_t> distances = SquaredDistancesUpTo_cells2(
      MaskOf(states, CellState::kOccupied), static_cast<int>(std::ceil(radius_cells)));
  Grid<std::uint8_t> traversable(states.geometry());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const bool ok = states[i] == CellState::kFree && distances[i] > radius_cells2;
    traversable[i] = ok ? 1 : 0;
  }
  return traversable;
}

}  // namespace plumescout
