// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/grid_geometry.h"

#include <algorithm>
#include <cmath>

namespace plumescout {
namespace {

int Coordinate(double offset_m, double resolution_m) {
  constexpr double kLimit = 1 << 30;
  // A point on a cell edge that rounding puts a hair below it belongs to the cell above.
  const double cells = std::floor(offset_m / resolution_m + 1e-9);
  return static_cast<int>(std::clamp(cells, -kLimit, kLimit));
}

}  // namespace

Cell GridGeometry::CellAt(Point2 point) const {
  return {Coordinate(point.x_m - origin_x_m, resolution_m),
          Coordinate(point.y_m - origin_y_m, resolution_m)};
}

}  // namespace plumescout
