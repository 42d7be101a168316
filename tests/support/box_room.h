// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout::support {

struct Disc {
  Point2 center;
  double radius_m = 0.0;
};

// Distance along the ray to the disc, infinity if it misses.
inline double RangeToDisc_m(Point2 from, double bearing_rad, const Disc& disc) {
  const double dx = disc.center.x_m - from.x_m;
  const double dy = disc.center.y_m - from.y_m;
  const double along = dx * std::cos(bearing_rad) + dy * std::sin(bearing_rad);
  const double across2 = dx * dx + dy * dy - along * along;
  const double half_chord2 = disc.radius_m * disc.radius_m - across2;
  if (along <= 0.0 || half_chord2 < 0.0) return std::numeric_limits<double>::infinity();
  return along - std::sqrt(half_chord2);
}

// Noise-free scan (360 beams, 8 m) of a robot in the empty room [0, width] x [0, height], in which
// the discs stand.
inline Scan ScanInBox(const Pose2& pose, double width_m, double height_m,
                      const std::vector<Disc>& discs = {}) {
  constexpr int kBeams = 360;
  Scan scan{-M_PI, 2.0 * M_PI / kBeams, 8.0, {}};
  for (int beam = 0; beam < kBeams; ++beam) {
    const double bearing_rad = pose.yaw_rad + scan.start_angle_rad + beam * scan.angle_step_rad;
    const double c = std::cos(bearing_rad);
    const double s = std::sin(bearing_rad);
    const double to_x_m = c > 0 ? (width_m - pose.x_m) / c : c < 0 ? -pose.x_m / c : INFINITY;
    const double to_y_m = s > 0 ? (height_m - pose.y_m) / s : s < 0 ? -pose.y_m / s : INFINITY;
    double range_m = std::min(to_x_m, to_y_m);
    for (const Disc& disc : discs) {
      range_m = std::min(range_m, RangeToDisc_m(pose.position(), bearing_rad, disc));
    }
    scan.ranges_m.push_back(range_m <= scan.max_range_m ? static_cast<float>(range_m)
                                                        : std::numeric_limits<float>::infinity());
  }
  return scan;
}

}  // namespace plumescout::support
