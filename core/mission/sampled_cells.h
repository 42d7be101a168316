// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "core/types/grid.h"
#include "core/types/pose2.h"

namespace plumescout {

// The cells in which gas readings were taken, by their place in the world: cells of a map that
// grows move, these do not. Thread-compatible.
class SampledCells {
 public:
  // Of maps with this resolution, whose cell edges lie on whole multiples of it.
  explicit SampledCells(double resolution_m) : resolution_m_(resolution_m) {}

  // Whether the cell is new. Cost: O(log cells).
  bool Add(Point2 place) { return cells_.insert({Index(place.x_m), Index(place.y_m)}).second; }

  // 1: sampled. Cost: O(cells).
  Grid<std::uint8_t> On(const GridGeometry& geometry) const {
    Grid<std::uint8_t> raster(geometry, 0);
    constexpr double kMiddle = 0.5;
    for (const auto& [x, y] : cells_) {
      const Cell cell = geometry.CellAt({(static_cast<double>(x) + kMiddle) * resolution_m_,
                                         (static_cast<double>(y) + kMiddle) * resolution_m_});
      if (geometry.Contains(cell)) raster[cell] = 1;
    }
    return raster;
  }

  // See core/types/byte_archive.h.
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self) {
    archive(self.cells_);
  }

 private:
  std::int64_t Index(double coordinate_m) const {
    return static_cast<std::int64_t>(std::floor(coordinate_m / resolution_m_));
  }

  double resolution_m_;
  std::set<std::pair<std::int64_t, std::int64_t>> cells_;
};

}  // namespace plumescout
