// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/types/grid.h"
#include "core/types/pose2.h"
#include "core/types/rng.h"

namespace plumescout {

// Draws points uniformly from the marked cells of a raster. That is kinder to a planner than
// drawing from the whole space and throwing away what is blocked.
class CellSampler {
 public:
  explicit CellSampler(const Grid<std::uint8_t>& domain);

  bool empty() const { return cells_.empty(); }
  std::size_t size() const { return cells_.size(); }

  // REQUIRES: !empty().
  Point2 Draw(Rng& rng) const;

  // Drops every cell that no way from `a` to `b` of this length can touch: all outside an ellipse.
  void Confine(Point2 a, Point2 b, double length_m);

 private:
  GridGeometry geometry_;
  std::vector<Cell> cells_;
};

}  // namespace plumescout
