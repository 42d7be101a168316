// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/scan_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/grid/ray.h"

namespace plumescout {
namespace {

// Returns and walls err by a cell or so each.
constexpr double kBeside_m = 0.2;
constexpr double kBeyond_m = 0.3;

enum class Surroundings { kOccupied, kFree, kUnknown };

Surroundings Around(Cell cell, int reach_cells, const Grid<CellState>& states) {
  bool all_free = true;
  for (int y = cell.y - reach_cells; y <= cell.y + reach_cells; ++y) {
    for (int x = cell.x - reach_cells; x <= cell.x + reach_cells; ++x) {
      const CellState state = states.At({x, y}, CellState::kUnknown);
      if (state == CellState::kOccupied) return Surroundings::kOccupied;
      all_free = all_free && state == CellState::kFree;
    }
  }
  return all_free ? Surroundings::kFree : Surroundings::kUnknown;
}

// How much of the segment is left, in cells, where it comes through the first wall; 0: none.
double LeftBehindWall_cells(Point2 from, Point2 to, const Grid<CellState>& states) {
  const bool along_x = std::abs(to.x_m - from.x_m) >= std::abs(to.y_m - from.y_m);
  const Cell aside = along_x ? Cell{0, 1} : Cell{1, 0};
  const auto occupied = [&](int x, int y) {
    return states.At({x, y}, CellState::kUnknown) == CellState::kOccupied;
  };
  double gone_cells = 0.0;
  double at_cells = -1.0;
  WalkSegment(states.geometry(), from, to, [&](Cell cell, double length_cells) {
    if (at_cells < 0.0 && occupied(cell.x, cell.y) &&
        occupied(cell.x + aside.x, cell.y + aside.y) &&
        occupied(cell.x - aside.x, cell.y - aside.y)) {
      at_cells = gone_cells;
    }
    gone_cells += length_cells;
    return true;
  });
  return at_cells < 0.0 ? 0.0 : gone_cells - at_cells;
}

}  // namespace

ScanFit FitOf(const Pose2& sensor_pose, const Scan& scan, const std::vector<MaskDisc>& masks,
              const OccupancyGrid& grid) {
  ScanFit fit;
  const Grid<CellState>& states = grid.States();
  if (states.size() == 0) return fit;
  const double resolution_m = grid.geometry().resolution_m;
  const int beside_cells = std::max(1, static_cast<int>(std::lround(kBeside_m / resolution_m)));
  const double beyond_cells = std::max(2.0, kBeyond_m / resolution_m);
  const auto most = static_cast<std::size_t>(kMostJudgedBeams);
  const std::size_t step = (scan.ranges_m.size() + most - 1) / most;
  for (std::size_t i = 0; i < scan.ranges_m.size(); i += step) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m > 0.0 && range_m <= scan.max_range_m)) continue;
    const double angle_rad =
        sensor_pose.yaw_rad + scan.start_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
    const Point2 end = {sensor_pose.x_m + range_m * std::cos(angle_rad),
                        sensor_pose.y_m + range_m * std::sin(angle_rad)};
    if (IsMasked(end, masks)) continue;
    if (LeftBehindWall_cells(sensor_pose.position(), end, states) > beyond_cells) {
      ++fit.beyond;
      continue;
    }
    const Surroundings around = Around(states.geometry().CellAt(end), beside_cells, states);
    if (around == Surroundings::kOccupied) ++fit.fitting;
    if (around == Surroundings::kFree) ++fit.short_of;
  }
  return fit;
}

}  // namespace plumescout
