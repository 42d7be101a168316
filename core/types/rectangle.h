// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/pose2.h"

namespace plumescout {

// Axis-parallel, in frame map.
struct Rectangle {
  Point2 min;
  Point2 max;

  double width_m() const { return max.x_m - min.x_m; }
  double height_m() const { return max.y_m - min.y_m; }

  friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

}  // namespace plumescout
