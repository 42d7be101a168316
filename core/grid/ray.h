// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"

namespace plumescout {

// One axis of a walk along a segment: the column (or row) it is in and when it leaves it.
struct RayAxis {
  RayAxis(double start, double delta, int first, int last_cell)
      : start_cells(start),
        inverse_delta(1.0 / delta),
        cell(first),
        last(last_cell),
        step(last_cell > first ? 1 : -1) {
    FindNext();
  }

  void Advance() {
    cell += step;
    FindNext();
  }

  // Computed afresh for every edge, so that rounding does not add up along the walk.
  void FindNext() {
    next = cell == last
               ? std::numeric_limits<double>::infinity()
               : (static_cast<double>(step > 0 ? cell + 1 : cell) - start_cells) * inverse_delta;
  }

  double start_cells;
  double inverse_delta;
  int cell;
  int last;
  int step;
  double next = 0.0;  // parameter t in [0, 1] of the next crossing; infinite in the last cell
};

// Walks the cells that the segment from `from` to `to` (frame map) crosses, in order, by exact
// grid traversal (Amanatides and Woo). `visit(cell, length_cells)` gets the length of the segment
// inside the cell in units of the cell edge and returns false to stop. Lengths add up to the
// length of the segment; cells may lie outside the raster; a point is one cell of length 0.
//
// A segment through the corner of four cells touches the two cells beside its way with length 0,
// so that the walk sees the same cells in both directions and cannot slip between two walls that
// meet at a corner. That is the corner rule of core/grid/neighbours.h.
//
// Returns false if a visit stopped the walk. Cost: O(cells crossed).
// REQUIRES: finite points, fewer than 2^30 cells apart; `first` and `last` are the cells that hold
// them.
template <typename Visit>
bool WalkSegment(const GridGeometry& geometry, Point2 from, Cell first, Point2 to, Cell last,
                 Visit&& visit) {
  // Crossings of both axes nearer than this are one corner; as wide as the edges of CellAt.
  constexpr double kCorner_cells = 1e-9;
  const double dx = (to.x_m - from.x_m) / geometry.resolution_m;
  const double dy = (to.y_m - from.y_m) / geometry.resolution_m;
  const double length_cells = std::sqrt(dx * dx + dy * dy);
  RayAxis x((from.x_m - geometry.origin_x_m) / geometry.resolution_m, dx, first.x, last.x);
  RayAxis y((from.y_m - geometry.origin_y_m) / geometry.resolution_m, dy, first.y, last.y);
  double t = 0.0;
  while (x.cell != last.x || y.cell != last.y) {
    const double next = std::clamp(std::min(x.next, y.next), t, 1.0);
    if (!visit(Cell{x.cell, y.cell}, (next - t) * length_cells)) return false;
    t = next;
    if (std::abs(x.next - y.next) * length_cells <= kCorner_cells) {
      if (!visit(Cell{x.cell + x.step, y.cell}, 0.0)) return false;
      if (!visit(Cell{x.cell, y.cell + y.step}, 0.0)) return false;
      x.Advance();
      y.Advance();
    } else if (x.next < y.next) {
      x.Advance();
    } else {
      y.Advance();
    }
  }
  return visit(last, (1.0 - t) * length_cells);
}

template <typename Visit>
bool WalkSegment(const GridGeometry& geometry, Point2 from, Point2 to, Visit&& visit) {
  return WalkSegment(geometry, from, geometry.CellAt(from), to, geometry.CellAt(to),
                     std::forward<Visit>(visit));
}

}  // namespace plumescout
