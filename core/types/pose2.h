// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace plumescout {

// Position in frame `map`: x east, y north, metres.
struct Point2 {
  double x_m = 0.0;
  double y_m = 0.0;

  friend bool operator==(const Point2&, const Point2&) = default;
};

// Position and heading in frame `map`; yaw counter-clockwise from +x, in (-pi, pi].
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;

  Point2 position() const { return {x_m, y_m}; }
  friend bool operator==(const Pose2&, const Pose2&) = default;
};

inline double Distance_m(Point2 a, Point2 b) { return std::hypot(b.x_m - a.x_m, b.y_m - a.y_m); }

// The angle in (-pi, pi] that differs from `angle_rad` by whole turns.
inline double WrapAngle_rad(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * M_PI);
  return wrapped <= -M_PI ? M_PI : wrapped;
}

}  // namespace plumescout
