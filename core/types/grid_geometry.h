// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/types/cell.h"
#include "core/types/pose2.h"

namespace plumescout {

// Where a raster lies in frame `map`. Cell (0,0) has its lower-left corner at the origin; cell
// (x,y) covers [origin + x*resolution, origin + (x+1)*resolution) on each axis. Rasters are stored
// row by row from the south: index = y * width + x.
struct GridGeometry {
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  double resolution_m = 0.1;
  int width = 0;
  int height = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  bool Contains(Cell cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.x < width && cell.y < height;
  }
  // REQUIRES: Contains(cell).
  std::size_t Index(Cell cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(cell.x);
  }
  Cell CellAtIndex(std::size_t index) const {
    const auto w = static_cast<std::size_t>(width);
    return {static_cast<int>(index % w), static_cast<int>(index / w)};
  }
  // The cell that holds the point, which may lie outside the raster. Saturates at +-2^30.
  Cell CellAt(Point2 point) const {
    return {Coordinate((point.x_m - origin_x_m) / resolution_m),
            Coordinate((point.y_m - origin_y_m) / resolution_m)};
  }
  Point2 Center(Cell cell) const {
    return {origin_x_m + (cell.x + 0.5) * resolution_m, origin_y_m + (cell.y + 0.5) * resolution_m};
  }

  friend bool operator==(const GridGeometry&, const GridGeometry&) = default;

 private:
  // Without std::floor, which is a call where no processor is named to compile for.
  static int Coordinate(double offset_cells) {
    constexpr double kLimit = 1 << 30;
    // A point on a cell edge that rounding puts a hair below it belongs to the cell above.
    constexpr double kEdge_cells = 1e-9;
    const double cells = std::clamp(offset_cells + kEdge_cells, -kLimit, kLimit);
    const int toward_zero = static_cast<int>(cells);
    return toward_zero - (static_cast<double>(toward_zero) > cells ? 1 : 0);
  }
};

}  // namespace plumescout
