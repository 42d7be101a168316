// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/line_of_sight.h"

#include <algorithm>
#include <tuple>

#include "core/grid/ray.h"

namespace plumescout::lab {
namespace {

// The last but one cell on the line between the centres of cell (0,0) and `offset`.
Cell CellBefore(Cell offset) {
  GridGeometry unit;
  unit.resolution_m = 1.0;
  Cell before;
  WalkSegment(unit, unit.Center({0, 0}), unit.Center(offset), [&](Cell cell, double) {
    if (cell != offset) before = cell;
    return true;
  });
  return before;
}

}  // namespace

LineOfSight::LineOfSight(const Grid<CellState>& occupancy, int radius_cells)
    : occupancy_(occupancy), radius_cells_(radius_cells), seen_(occupancy.size()) {
  for (int y = -radius_cells; y <= radius_cells; ++y) {
    for (int x = -radius_cells; x <= radius_cells; ++x) {
      if (x != 0 || y != 0) rays_.push_back({{x, y}, CellBefore({x, y})});
    }
  }
  // The cell before is nearer in city blocks, so it has been decided when it is asked for.
  std::sort(rays_.begin(), rays_.end(), [](const Ray& a, const Ray& b) {
    const int blocks_a = std::abs(a.offset.x) + std::abs(a.offset.y);
    const int blocks_b = std::abs(b.offset.x) + std::abs(b.offset.y);
    return std::tie(blocks_a, a.offset) < std::tie(blocks_b, b.offset);
  });
}

std::span<const std::uint64_t> LineOfSight::From(Cell viewer) {
  std::vector<std::uint64_t>& rows = seen_[occupancy_.geometry().Index(viewer)];
  if (rows.empty()) rows = Look(viewer);
  return rows;
}

std::vector<std::uint64_t> LineOfSight::Look(Cell viewer) const {
  std::vector<std::uint64_t> rows(static_cast<std::size_t>(2 * radius_cells_ + 1));
  const auto row = [&](int dy) -> std::uint64_t& {
    return rows[static_cast<std::size_t>(dy + radius_cells_)];
  };
  const auto bit = [this](int dx) { return std::uint64_t{1} << (dx + radius_cells_); };
  row(0) |= bit(0);
  for (const Ray& ray : rays_) {
    if ((row(ray.before.y) & bit(ray.before.x)) == 0) continue;
    const Cell cell{viewer.x + ray.offset.x, viewer.y + ray.offset.y};
    if (occupancy_.At(cell, CellState::kOccupied) != CellState::kFree) continue;
    row(ray.offset.y) |= bit(ray.offset.x);
  }
  return rows;
}

}  // namespace plumescout::lab
