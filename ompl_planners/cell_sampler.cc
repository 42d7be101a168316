// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/cell_sampler.h"

#include <numbers>

namespace plumescout {

CellSampler::CellSampler(const Grid<std::uint8_t>& domain) : geometry_(domain.geometry()) {
  for (std::size_t i = 0; i < domain.size(); ++i) {
    if (domain[i] != 0) cells_.push_back(geometry_.CellAtIndex(i));
  }
}

Point2 CellSampler::Draw(Rng& rng) const {
  const double half_m = geometry_.resolution_m / 2.0;
  const Point2 center = geometry_.Center(cells_[rng.Below(cells_.size())]);
  const double dx_m = rng.Uniform(-half_m, half_m);
  const double dy_m = rng.Uniform(-half_m, half_m);
  return {center.x_m + dx_m, center.y_m + dy_m};
}

void CellSampler::Confine(Point2 a, Point2 b, double length_m) {
  // No point of a cell is farther from its centre than half a diagonal, and there are two legs.
  const double reach_m = length_m + std::numbers::sqrt2 * geometry_.resolution_m;
  std::erase_if(cells_, [&](Cell cell) {
    const Point2 center = geometry_.Center(cell);
    return Distance_m(a, center) + Distance_m(center, b) > reach_m;
  });
}

}  // namespace plumescout
