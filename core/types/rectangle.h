// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "core/types/pose2.h"

namespace plumescout {

// Axis-parallel, in frame map.
struct Rectangle {
  Point2 min;
  Point2 max;

  static Rectangle Sized(Point2 min, double width_m, double height_m) {
    return {min, {min.x_m + width_m, min.y_m + height_m}};
  }

  double width_m() const { return max.x_m - min.x_m; }
  double height_m() const { return max.y_m - min.y_m; }

  // Inside, not on an edge.
  bool Surrounds(Point2 point) const {
    return point.x_m > min.x_m && point.x_m < max.x_m && point.y_m > min.y_m && point.y_m < max.y_m;
  }
  // In more than an edge.
  bool Overlaps(const Rectangle& other) const {
    return min.x_m < other.max.x_m && other.min.x_m < max.x_m && min.y_m < other.max.y_m &&
           other.min.y_m < max.y_m;
  }
  // Larger by so much on each side, smaller if it is negative.
  Rectangle Grown(double by_m) const {
    return {{min.x_m - by_m, min.y_m - by_m}, {max.x_m + by_m, max.y_m + by_m}};
  }
  // The smallest that holds both.
  Rectangle With(const Rectangle& other) const {
    return {{std::min(min.x_m, other.min.x_m), std::min(min.y_m, other.min.y_m)},
            {std::max(max.x_m, other.max.x_m), std::max(max.y_m, other.max.y_m)}};
  }
  // From the point to the nearest one of the rectangle.
  double Distance_m(Point2 point) const {
    return std::hypot(std::max({min.x_m - point.x_m, point.x_m - max.x_m, 0.0}),
                      std::max({min.y_m - point.y_m, point.y_m - max.y_m, 0.0}));
  }

  friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

}  // namespace plumescout
