// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"

namespace plumescout {

// Walks the cells that the segment from `from` to `to` (frame map) crosses, in order, by exact
// grid traversal (Amanatides and Woo). `visit(cell, length_cells)` gets the length of the segment
// inside the cell in units of the cell edge and returns false to stop. Lengths add up to the
// length of the segment; cells may lie outside the raster; a point is one cell of length 0.
// Returns false if a visit stopped the walk. Cost: O(cells crossed).
template <typename Visit>
bool WalkSegment(const GridGeometry& geometry, Point2 from, Point2 to, Visit&& visit) {
  const double ax = (from.x_m - geometry.origin_x_m) / geometry.resolution_m;
  const double ay = (from.y_m - geometry.origin_y_m) / geometry.resolution_m;
  const double dx = (to.x_m - from.x_m) / geometry.resolution_m;
  const double dy = (to.y_m - from.y_m) / geometry.resolution_m;
  const double length_cells = std::hypot(dx, dy);
  Cell cell = geometry.CellAt(from);
  const Cell last = geometry.CellAt(to);
  const int step_x = dx > 0.0 ? 1 : -1;
  const int step_y = dy > 0.0 ? 1 : -1;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  // Parameter t in [0, 1] at which the segment crosses the next vertical and horizontal edge.
  const auto crossing = [](double a, double d, int c, int step) {
    return d == 0.0 ? kNever : (static_cast<double>(c + (step > 0 ? 1 : 0)) - a) / d;
  };
  double t = 0.0;
  int remaining = std::abs(last.x - cell.x) + std::abs(last.y - cell.y);
  while (remaining-- > 0) {
    double next_x = cell.x == last.x ? kNever : crossing(ax, dx, cell.x, step_x);
    double next_y = cell.y == last.y ? kNever : crossing(ay, dy, cell.y, step_y);
    const double next = std::clamp(std::min(next_x, next_y), t, 1.0);
    if (!visit(cell, (next - t) * length_cells)) return false;
    if (next_x <= next_y) {
      cell.x += step_x;
    } else {
      cell.y += step_y;
    }
    t = next;
  }
  return visit(cell, (1.0 - t) * length_cells);
}

}  // namespace plumescout
