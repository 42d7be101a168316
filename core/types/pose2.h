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

// Not by std::hypot, a call that guards against lengths no map has.
inline double Distance_m(Point2 a, Point2 b) {
  const double dx_m = b.x_m - a.x_m;
  const double dy_m = b.y_m - a.y_m;
  return std::sqrt(dx_m * dx_m + dy_m * dy_m);
}

// The angle in (-pi, pi] that differs from `angle_rad` by whole turns.
inline double WrapAngle_rad(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * M_PI);
  return wrapped <= -M_PI ? M_PI : wrapped;
}

// Poses as transforms: what `b` is in the frame in which `a` is given, if `b` is given in the frame
// whose origin is `a`.
inline Pose2 Compose(const Pose2& a, const Pose2& b) {
  const double cos = std::cos(a.yaw_rad);
  const double sin = std::sin(a.yaw_rad);
  return {a.x_m + cos * b.x_m - sin * b.y_m, a.y_m + sin * b.x_m + cos * b.y_m,
          WrapAngle_rad(a.yaw_rad + b.yaw_rad)};
}

// Where something is that is so far ahead and to the left of what has the pose.
inline Point2 PlaceOnRobot(const Pose2& pose, Point2 robot_from_place) {
  return Compose(pose, {robot_from_place.x_m, robot_from_place.y_m, 0.0}).position();
}

// Compose(a, Inverse(a)) is the pose at the origin, but for rounding.
inline Pose2 Inverse(const Pose2& a) {
  const double cos = std::cos(a.yaw_rad);
  const double sin = std::sin(a.yaw_rad);
  return {-cos * a.x_m - sin * a.y_m, sin * a.x_m - cos * a.y_m, WrapAngle_rad(-a.yaw_rad)};
}

}  // namespace plumescout
