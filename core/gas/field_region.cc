// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field_region.h"

#include <algorithm>
#include <cmath>

namespace plumescout {

FieldRegion::FieldRegion(double reach_m, double resolution_m)
    : reach_m_(reach_m),
      resolution_m_(resolution_m),
      everywhere_(reach_m == 0.0),
      reach_tiles_(static_cast<std::int64_t>(
          std::floor(reach_m / (static_cast<double>(kTileCells) * resolution_m)))) {}

FieldRegion::Tile FieldRegion::TileAt(Point2 place) const {
  const Cell cell = GridGeometry{0.0, 0.0, resolution_m_, 0, 0}.CellAt(place);
  return {TileOfCell(cell.x), TileOfCell(cell.y)};
}

void FieldRegion::Visit(Point2 place) {
  if (everywhere_) return;
  const Tile tile = TileAt(place);
  if (visited_.insert(tile).second) Mark(tile);
}

void FieldRegion::VisitAll(const GridGeometry& geometry) {
  const double step_m = kTileCells * geometry.resolution_m;
  const double east_m = geometry.origin_x_m + geometry.width * geometry.resolution_m;
  const double north_m = geometry.origin_y_m + geometry.height * geometry.resolution_m;
  for (double y_m = geometry.origin_y_m; y_m < north_m + step_m; y_m += step_m) {
    for (double x_m = geometry.origin_x_m; x_m < east_m + step_m; x_m += step_m) {
      Visit({std::min(x_m, east_m), std::min(y_m, north_m)});
    }
  }
}

// The gap between two tiles.
bool FieldRegion::IsNear(std::int64_t dx, std::int64_t dy) const {
  const double tile_m = static_cast<double>(kTileCells) * resolution_m_;
  const double gap_x_m = static_cast<double>(std::max<std::int64_t>(0, std::abs(dx) - 1)) * tile_m;
  const double gap_y_m = static_cast<double>(std::max<std::int64_t>(0, std::abs(dy) - 1)) * tile_m;
  return std::hypot(gap_x_m, gap_y_m) <= reach_m_;
}

std::int64_t FieldRegion::TilesAround() const {
  constexpr std::int64_t kManyTiles = 100;
  std::int64_t tiles = 0;
  const std::int64_t most = reach_tiles_ + 1;
  if (most > kManyTiles) return (2 * most + 1) * (2 * most + 1);
  for (std::int64_t y = -most; y <= most; ++y) {
    for (std::int64_t x = -most; x <= most; ++x) tiles += IsNear(x, y) ? 1 : 0;
  }
  return tiles;
}

void FieldRegion::Follow(const GridGeometry& geometry) {
  if (everywhere_ || geometry == geometry_) return;
  geometry_ = geometry;
  const GridGeometry lattice = {0.0, 0.0, resolution_m_, 0, 0};
  const Cell corner = lattice.CellAt(geometry.Center({0, 0}));
  corner_ = {TileOfCell(corner.x), TileOfCell(corner.y)};
  width_ = geometry.width / kTileCells;
  height_ = geometry.height / kTileCells;
  inside_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
  inside_count_ = 0;
  for (const Tile& tile : visited_) Mark(tile);
}

void FieldRegion::Mark(const Tile& visited) {
  const std::int64_t most = reach_tiles_ + 1;
  const std::int64_t x = visited.x - corner_.x;
  const std::int64_t y = visited.y - corner_.y;
  const std::int64_t y_end = std::min<std::int64_t>(height_, y + most + 1);
  const std::int64_t x_end = std::min<std::int64_t>(width_, x + most + 1);
  for (std::int64_t row = std::max<std::int64_t>(0, y - most); row < y_end; ++row) {
    for (std::int64_t column = std::max<std::int64_t>(0, x - most); column < x_end; ++column) {
      std::uint8_t& inside = inside_[TileIndex(static_cast<int>(column), static_cast<int>(row))];
      if (inside != 0 || !IsNear(column - x, row - y)) continue;
      inside = 1;
      ++inside_count_;
    }
  }
}

const Grid<CellState>& FieldRegion::Within(const Grid<CellState>& states) {
  if (everywhere_) return states;
  Follow(states.geometry());
  return inside_count_ == inside_.size() ? states : Cut(states);
}

// The tiles of the region and as many more as a rectangle around them takes; of those beyond it
// nothing is known.
const Grid<CellState>& FieldRegion::Cut(const Grid<CellState>& states) {
  int x0 = width_;
  int y0 = height_;
  int x1 = 0;
  int y1 = 0;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      if (inside_[TileIndex(x, y)] == 0) continue;
      x0 = std::min(x0, x);
      y0 = std::min(y0, y);
      x1 = std::max(x1, x + 1);
      y1 = std::max(y1, y + 1);
    }
  }
  GridGeometry geometry = geometry_;
  if (x0 >= x1) {
    geometry.width = geometry.height = 0;
    part_ = Grid<CellState>(geometry);
    return part_;
  }
  const double tile_m = kTileCells * resolution_m_;
  // As the map reckons its own origin, so that all are whole cells apart.
  geometry.origin_x_m = static_cast<double>(corner_.x + x0) * tile_m;
  geometry.origin_y_m = static_cast<double>(corner_.y + y0) * tile_m;
  geometry.width = (x1 - x0) * kTileCells;
  geometry.height = (y1 - y0) * kTileCells;
  part_ = Grid<CellState>(geometry, CellState::kUnknown);
  for (int y = y0 * kTileCells; y < y1 * kTileCells; ++y) {
    for (int x = x0; x < x1; ++x) {
      if (inside_[TileIndex(x, y / kTileCells)] == 0) continue;
      const auto from = static_cast<std::ptrdiff_t>(geometry_.Index({x * kTileCells, y}));
      const auto to =
          static_cast<std::ptrdiff_t>(geometry.Index({(x - x0) * kTileCells, y - y0 * kTileCells}));
      std::copy_n(states.values().begin() + from, kTileCells, part_.values().begin() + to);
    }
  }
  return part_;
}

}  // namespace plumescout
