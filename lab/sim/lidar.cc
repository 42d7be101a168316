// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/lidar.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "core/grid/ray.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

constexpr int kMaxBeams = 20'000;
constexpr double kMaxRange_m = 100.0;
constexpr double kMaxNoise_m = 1.0;
constexpr double kTouch_cells = 1e-9;  // a beam through a corner touches cells but crosses none
constexpr double kNoReturn_m = std::numeric_limits<double>::infinity();

absl::Status OutOfRange(const char* field, double value, const char* range) {
  return absl::InvalidArgumentError(
      absl::StrCat("lidar.", field, " = ", value, " must be ", range));
}

}  // namespace

absl::Status Validate(const LidarOptions& options) {
  if (options.beams < 1 || options.beams > kMaxBeams) {
    return OutOfRange("beams", options.beams, "in [1, 20000]");
  }
  if (!(options.max_range_m > 0.0 && options.max_range_m <= kMaxRange_m)) {
    return OutOfRange("max_range_m", options.max_range_m, "in (0, 100]");
  }
  if (!(options.noise_sigma_m >= 0.0 && options.noise_sigma_m <= kMaxNoise_m)) {
    return OutOfRange("noise_sigma_m", options.noise_sigma_m, "in [0, 1]");
  }
  return absl::OkStatus();
}

double CastBeam_m(const Grid<CellState>& truth, Point2 from, double angle_rad, double max_range_m) {
  const GridGeometry& geometry = truth.geometry();
  // Far enough to leave the cell in which the range ends: what it holds of the beam counts whole.
  const double reach_m = max_range_m + 2.0 * geometry.resolution_m;
  const Point2 to{from.x_m + reach_m * std::cos(angle_rad),
                  from.y_m + reach_m * std::sin(angle_rad)};
  double before_cells = 0.0;
  double range_m = kNoReturn_m;
  WalkSegment(geometry, from, to, [&](Cell cell, double length_cells) {
    const double edge_m = before_cells * geometry.resolution_m;
    if (edge_m > max_range_m) return false;
    const bool crossed = length_cells > kTouch_cells;
    if (crossed && truth.At(cell, CellState::kFree) == CellState::kOccupied) {
      range_m = edge_m + 0.5 * length_cells * geometry.resolution_m;
      return false;
    }
    before_cells += length_cells;
    return true;
  });
  return range_m <= max_range_m ? range_m : kNoReturn_m;
}

Lidar::Lidar(const LidarOptions& options, std::uint64_t seed) : options_(options), rng_(seed) {}

Scan Lidar::Take(const Grid<CellState>& truth, const Pose2& pose) {
  Scan scan;
  scan.start_angle_rad = -M_PI;
  scan.angle_step_rad = 2.0 * M_PI / options_.beams;
  scan.max_range_m = options_.max_range_m;
  scan.ranges_m.reserve(static_cast<std::size_t>(options_.beams));
  for (int beam = 0; beam < options_.beams; ++beam) {
    const double angle_rad = pose.yaw_rad + scan.start_angle_rad + beam * scan.angle_step_rad;
    double range_m = CastBeam_m(truth, pose.position(), angle_rad, options_.max_range_m);
    range_m = std::max(0.0, range_m + options_.noise_sigma_m * rng_.Gaussian());
    if (range_m > options_.max_range_m) range_m = kNoReturn_m;
    scan.ranges_m.push_back(static_cast<float>(range_m));
  }
  return scan;
}

}  // namespace plumescout::lab
