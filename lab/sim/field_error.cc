// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/field_error.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace plumescout::lab {

double FieldRmse_ppm(const Scene& truth, const MapSnapshot& map, double background_ppm) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const GridGeometry& geometry = truth.geometry();
  double squares = 0.0;
  int cells = 0;
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    if (truth.occupancy[i] != CellState::kFree) continue;
    const Point2 center = geometry.Center(geometry.CellAtIndex(i));
    const double mean = map.gas_mean_ppm.At(map.gas_mean_ppm.geometry().CellAt(center), kNone);
    const double error =
        (std::isnan(mean) ? background_ppm : mean) - static_cast<double>(truth.conc_mean_ppm[i]);
    squares += error * error;
    ++cells;
  }
  return std::sqrt(squares / cells);
}

}  // namespace plumescout::lab
