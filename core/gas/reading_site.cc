// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace plumescout {
namespace {

constexpr std::array<Cell, 8> kNeighbours = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
constexpr std::uint32_t kSides = 4;  // the first of them, across a side; the others, a corner
constexpr std::uint32_t kBits = 3;   // of one neighbour's number
constexpr std::uint32_t kMask = (1U << kBits) - 1;

// Offsets are counted in millionths of a cell, so that equal distances compare equal whatever the
// rounding of the position.
constexpr double kStepsPerCell = 1e6;
constexpr std::int64_t kHalfCell = 500'000;

std::int64_t Steps(double offset_m, double resolution_m) {
  const double steps = std::round(offset_m / resolution_m * kStepsPerCell);
  return std::clamp(static_cast<std::int64_t>(std::clamp(steps, -kStepsPerCell, kStepsPerCell)),
                    -kHalfCell, kHalfCell);
}

std::uint32_t NeighbourOrder(std::int64_t offset_x, std::int64_t offset_y) {
  std::array<std::uint32_t, kNeighbours.size()> order = {0, 1, 2, 3, 4, 5, 6, 7};
  const auto squared_distance = [&](std::uint32_t number) {
    const std::int64_t dx = 2 * kHalfCell * kNeighbours[number].x - offset_x;
    const std::int64_t dy = 2 * kHalfCell * kNeighbours[number].y - offset_y;
    return dx * dx + dy * dy;
  };
  const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
    return squared_distance(a) < squared_distance(b);
  };
  std::stable_sort(order.begin(), order.begin() + kSides, nearer);
  std::stable_sort(order.begin() + kSides, order.end(), nearer);
  std::uint32_t packed = 0;
  for (std::size_t k = order.size(); k-- > 0;) packed = packed << kBits | order[k];
  return packed;
}

}  // namespace

ReadingSite SiteOf(Point2 position, const GridGeometry& anchor) {
  const Cell cell = anchor.CellAt(position);
  const Point2 center = anchor.Center(cell);
  return {{cell.x, cell.y},
          NeighbourOrder(Steps(position.x_m - center.x_m, anchor.resolution_m),
                         Steps(position.y_m - center.y_m, anchor.resolution_m))};
}

ReadingSite CentreOf(AnchorCell cell) {
  static const std::uint32_t order = NeighbourOrder(0, 0);
  return {cell, order};
}

Placement PlacementOf(const ReadingSite& site, const Grid<CellState>& states, AnchorCell corner) {
  const auto is_free = [&](AnchorCell cell) {
    // No overflow: sites are within 2^30 + 1 cells of the anchor, corners within 2^29.
    return states.At({cell.x - corner.x, cell.y - corner.y}, CellState::kUnknown) ==
           CellState::kFree;
  };
  if (is_free(site.cell)) return {site.cell, false};
  std::uint32_t order = site.neighbour_order;
  for (std::size_t k = 0; k < kNeighbours.size(); ++k, order >>= kBits) {
    const Cell step = kNeighbours[order & kMask];
    const AnchorCell neighbour{site.cell.x + step.x, site.cell.y + step.y};
    if (is_free(neighbour)) return {neighbour, true};
  }
  return {};
}

}  // namespace plumescout
