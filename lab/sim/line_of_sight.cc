// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/line_of_sight.h"

#include <algorithm>

#include "core/grid/neighbours.h"
#include "core/grid/ray.h"

namespace plumescout::lab {
namespace {

// Lines between centres often run exactly through corners. A cell that is only touched does not
// count: which of the two beside the corner the walk visits is chance.
constexpr double kTouch_cells = 1e-9;

}  // namespace

LineOfSight::LineOfSight(const Grid<CellState>& occupancy, int radius_cells)
    : occupancy_(occupancy),
      radius_cells_(radius_cells),
      is_surface_(occupancy.geometry()),
      seen_(occupancy.size()) {
  CastShadows();
  FindSurfaces();
}

LineOfSight::Rows& LineOfSight::ShadowOf(Cell offset) {
  const auto side = static_cast<std::size_t>(2 * radius_cells_ + 1);
  return shadows_[RowOf(offset.y) * side + RowOf(offset.x)];
}

void LineOfSight::CastShadows() {
  const auto side = static_cast<std::size_t>(2 * radius_cells_ + 1);
  shadows_.assign(side * side, Rows(side));
  GridGeometry unit;
  unit.resolution_m = 1.0;
  for (int y = -radius_cells_; y <= radius_cells_; ++y) {
    for (int x = -radius_cells_; x <= radius_cells_; ++x) {
      WalkSegment(unit, unit.Center({0, 0}), unit.Center({x, y}), [&](Cell cell, double length) {
        if (length > kTouch_cells) ShadowOf(cell)[RowOf(y)] |= BitOf(x);
        return true;
      });
    }
  }
}

void LineOfSight::FindSurfaces() {
  for (std::size_t i = 0; i < occupancy_.size(); ++i) {
    if (occupancy_[i] == CellState::kFree) continue;
    const Cell cell = occupancy_.geometry().CellAtIndex(i);
    is_surface_[i] = std::any_of(kNeighbours8.begin(), kNeighbours8.end(), [&](Cell offset) {
      return occupancy_.At(Shifted(cell, offset), CellState::kOccupied) == CellState::kFree;
    });
  }
}

std::span<const std::uint64_t> LineOfSight::From(Cell viewer) {
  Rows& rows = seen_[occupancy_.geometry().Index(viewer)];
  if (rows.empty()) rows = Look(viewer);
  return rows;
}

LineOfSight::Rows LineOfSight::Look(Cell viewer) {
  const int left = std::max(-radius_cells_, -viewer.x);
  const int right = std::min(radius_cells_, occupancy_.width() - 1 - viewer.x);
  const int bottom = std::max(-radius_cells_, -viewer.y);
  const int top = std::min(radius_cells_, occupancy_.height() - 1 - viewer.y);
  Rows rows(static_cast<std::size_t>(2 * radius_cells_ + 1));
  std::uint64_t columns = 0;
  for (int dx = left; dx <= right; ++dx) columns |= BitOf(dx);
  for (int dy = bottom; dy <= top; ++dy) rows[RowOf(dy)] = columns;
  for (int dy = bottom; dy <= top; ++dy) {
    for (int dx = left; dx <= right; ++dx) {
      if (is_surface_[Cell{viewer.x + dx, viewer.y + dy}] == 0) continue;
      const Rows& shadow = ShadowOf({dx, dy});
      for (std::size_t row = 0; row < rows.size(); ++row) rows[row] &= ~shadow[row];
    }
  }
  return rows;
}

}  // namespace plumescout::lab
