// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/lidar.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/grid/ray.h"
#include "core/types/checker.h"

namespace plumescout::lab {
namespace {

constexpr int kMaxBeams = 20'000;
constexpr double kMaxRange_m = 100.0;
constexpr double kMaxNoise_m = 1.0;
constexpr double kTouch_cells = 1e-9;  // a beam through a corner touches cells but crosses none
constexpr double kNoReturn_m = std::numeric_limits<double>::infinity();
constexpr double kSilence_m = std::numeric_limits<double>::quiet_NaN();

}  // namespace

absl::Status Validate(const LidarOptions& options) {
  return Checker()
      .InRange("lidar.beams", options.beams, 1, kMaxBeams)
      .InRangeAbove("lidar.max_range_m", options.max_range_m, 0.0, kMaxRange_m)
      .InRange("lidar.noise_sigma_m", options.noise_sigma_m, 0.0, kMaxNoise_m)
      .InRange("lidar.dropout_share", options.dropout_share, 0.0, 1.0)
      .status();
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

double CastBeamAtBodies_m(const std::vector<Body>& bodies, Point2 from, double angle_rad) {
  const Point2 direction{std::cos(angle_rad), std::sin(angle_rad)};
  double nearest_m = kNoReturn_m;
  for (const Body& body : bodies) {
    const Point2 to{body.center.x_m - from.x_m, body.center.y_m - from.y_m};
    const double along_m = to.x_m * direction.x_m + to.y_m * direction.y_m;
    const double across_m = to.x_m * direction.y_m - to.y_m * direction.x_m;
    const double half_chord_m2 = body.radius_m * body.radius_m - across_m * across_m;
    if (half_chord_m2 <= 0.0) continue;
    const double entry_m = along_m - std::sqrt(half_chord_m2);
    if (entry_m > 0.0) nearest_m = std::min(nearest_m, entry_m);
  }
  return nearest_m;
}

Lidar::Lidar(const LidarOptions& options, std::uint64_t seed) : options_(options), rng_(seed) {}

Scan Lidar::Take(const Grid<CellState>& truth, const Pose2& pose, const std::vector<Body>& bodies) {
  Scan scan;
  scan.start_angle_rad = -M_PI;
  scan.angle_step_rad = 2.0 * M_PI / options_.beams;
  scan.max_range_m = options_.max_range_m;
  scan.ranges_m.reserve(static_cast<std::size_t>(options_.beams));
  for (int beam = 0; beam < options_.beams; ++beam) {
    const double angle_rad = pose.yaw_rad + scan.start_angle_rad + beam * scan.angle_step_rad;
    double range_m = std::min(CastBeam_m(truth, pose.position(), angle_rad, options_.max_range_m),
                              CastBeamAtBodies_m(bodies, pose.position(), angle_rad));
    range_m = std::max(0.0, range_m + options_.noise_sigma_m * rng_.Gaussian());
    if (range_m > options_.max_range_m) range_m = kNoReturn_m;
    // Without dropouts nothing is drawn, so that scans are the same as if there were none.
    const bool dropped = options_.dropout_share > 0.0 && rng_.Uniform01() < options_.dropout_share;
    if (dropped) range_m = kSilence_m;
    scan.ranges_m.push_back(static_cast<float>(range_m));
  }
  return scan;
}

}  // namespace plumescout::lab
