// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/scan_inserter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/grid/ray.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr std::uint8_t kUntouched = 0;
constexpr std::uint8_t kPassed = 1;
constexpr std::uint8_t kHit = 2;

absl::Status Check(const Pose2& pose, const Scan& scan) {
  const bool ok = std::isfinite(pose.x_m) && std::isfinite(pose.y_m) &&
                  std::isfinite(pose.yaw_rad) && std::isfinite(scan.start_angle_rad) &&
                  std::isfinite(scan.angle_step_rad) && std::isfinite(scan.max_range_m) &&
                  scan.max_range_m > 0.0;
  if (ok) return absl::OkStatus();
  return absl::InvalidArgumentError("scan with a pose, angle or max_range_m that is no number");
}

// Eight cells at once.
bool IsUntouched(const std::uint8_t* cells) {
  std::uint64_t marks = 0;
  std::memcpy(&marks, cells, sizeof(marks));
  return marks == 0;
}

}  // namespace

bool IsMasked(Point2 point, const std::vector<MaskDisc>& masks) {
  return std::any_of(masks.begin(), masks.end(), [point](const MaskDisc& disc) {
    return Distance_m(point, disc.center) <= disc.radius_m;
  });
}

void ScanInserter::KeepBeams(const Pose2& sensor_pose, const Scan& scan,
                             const std::vector<MaskDisc>& masks) {
  // Ranges are floats: 8.1F lies a hair above 8.1.
  constexpr double kFloatRounding = 1.0 + std::numeric_limits<float>::epsilon();
  const double max_range_m = scan.max_range_m * kFloatRounding;
  beams_.clear();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = static_cast<double>(scan.ranges_m[i]);
    const bool no_return = std::isinf(range_m) && range_m > 0.0;
    if (!no_return && !(range_m > 0.0 && range_m <= max_range_m)) continue;
    const double reach_m = no_return ? scan.max_range_m : range_m;
    const double angle_rad =
        sensor_pose.yaw_rad + scan.start_angle_rad + static_cast<double>(i) * scan.angle_step_rad;
    const Point2 end = {sensor_pose.x_m + reach_m * std::cos(angle_rad),
                        sensor_pose.y_m + reach_m * std::sin(angle_rad)};
    if (!no_return && IsMasked(end, masks)) continue;
    beams_.push_back({end, !no_return});
  }
}

// A beam enters as many cells as it crosses columns and rows.
absl::Status ScanInserter::CheckCrossings(Point2 sensor, double resolution_m) const {
  double crossings = 0.0;
  for (const Beam& beam : beams_) {
    crossings +=
        (std::abs(beam.end.x_m - sensor.x_m) + std::abs(beam.end.y_m - sensor.y_m)) / resolution_m;
  }
  if (crossings <= kMostCrossings) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      "scan.ranges of ", beams_.size(), " beams cross ", std::ceil(crossings), " cells of ",
      resolution_m, " m, must cross at most ", kMostCrossings, " in all"));
}

void ScanInserter::MarkPassed(std::size_t index) {
  touched_[index] = std::max(touched_[index], kPassed);
}

void ScanInserter::Apply(Cell first, Cell last, OccupancyGrid& grid, int times) {
  constexpr std::size_t kAtOnce = sizeof(std::uint64_t);
  const double miss_log_odds = times * grid.options().miss_log_odds;
  const double hit_log_odds = times * grid.options().hit_log_odds;
  for (int y = first.y; y <= last.y; ++y) {
    const std::size_t end = touched_.geometry().Index({last.x, y}) + 1;
    std::size_t index = touched_.geometry().Index({first.x, y});
    while (index < end) {
      const std::size_t next = std::min(index + kAtOnce, end);
      if (next == index + kAtOnce && IsUntouched(&touched_[index])) {
        index = next;
        continue;
      }
      for (; index < next; ++index) {
        const std::uint8_t mark = std::exchange(touched_[index], kUntouched);
        if (mark != kUntouched) grid.Add(index, mark == kHit ? hit_log_odds : miss_log_odds);
      }
    }
  }
}

absl::Status ScanInserter::Insert(const Pose2& sensor_pose, const Scan& scan,
                                  const std::vector<MaskDisc>& masks, OccupancyGrid& grid,
                                  int times) {
  PLUMESCOUT_RETURN_IF_ERROR(Check(sensor_pose, scan));
  KeepBeams(sensor_pose, scan, masks);
  if (beams_.empty()) return absl::OkStatus();
  const Point2 sensor = sensor_pose.position();
  const OccupancyOptions& options = grid.options();
  const double depth_m = std::min(options.surface_depth_m, 0.5 * options.resolution_m);
  if (depth_m > 0.0) PutBehindSurfaces(sensor, depth_m, beams_);
  PLUMESCOUT_RETURN_IF_ERROR(CheckCrossings(sensor, grid.geometry().resolution_m));
  Point2 low = sensor;
  Point2 high = sensor;
  for (const Beam& beam : beams_) {
    low = {std::min(low.x_m, beam.end.x_m), std::min(low.y_m, beam.end.y_m)};
    high = {std::max(high.x_m, beam.end.x_m), std::max(high.y_m, beam.end.y_m)};
  }
  PLUMESCOUT_RETURN_IF_ERROR(grid.GrowToContain(low, high));
  const GridGeometry geometry = grid.geometry();
  if (touched_.geometry() != geometry) touched_ = Grid<std::uint8_t>(geometry);
  // Hits first: passing beams then leave those cells alone.
  for (const Beam& beam : beams_) {
    if (beam.hit) touched_[geometry.Index(geometry.CellAt(beam.end))] = kHit;
  }
  MarkPassed(geometry.Index(geometry.CellAt(sensor)));
  for (const Beam& beam : beams_) {
    WalkSegment(geometry, sensor, beam.end, [&](Cell cell, double length_cells) {
      // A cell touched at its edge or corner alone was not looked into.
      if (length_cells > 0.0) MarkPassed(geometry.Index(cell));
      return true;
    });
  }
  // The map has a cell more on every side.
  const Cell first = geometry.CellAt(low);
  const Cell last = geometry.CellAt(high);
  Apply({first.x - 1, first.y - 1}, {last.x + 1, last.y + 1}, grid, times);
  return absl::OkStatus();
}

}  // namespace plumescout
