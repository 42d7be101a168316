// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/air.h"

#include "core/grid/ray.h"

namespace plumescout::lab {

Air::Air(const LayoutRaster& raster, const MacField& wind)
    : geometry_(raster.occupancy.geometry()),
      cells_per_m_(1.0 / geometry_.resolution_m),
      cells_(geometry_.size()) {
  const Grid<GasSpace> spaces = GasSpaces(raster);
  const Grid<std::uint8_t> clearances = Clearances(spaces);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const auto [x, y] = geometry_.CellAtIndex(i);
    cells_[i] = {static_cast<float>(wind.u(x, y)),
                 static_cast<float>(wind.u(x + 1, y)),
                 static_cast<float>(wind.v(x, y)),
                 static_cast<float>(wind.v(x, y + 1)),
                 spaces[i],
                 clearances[i]};
  }
}

bool Air::WalkIsClear(Point2 from, Point2 to) const {
  return WalkSegment(geometry_, from, to,
                     [this](Cell cell, double) { return In(cell).space != GasSpace::kSolid; });
}

}  // namespace plumescout::lab
