// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/types/pose2.h"

namespace plumescout {

// Region of frame map, bounded by the segments between neighbouring vertices and from the last to
// the first. What it holds is by the even-odd rule, so it may cross itself and run either way.
struct Polygon {
  std::vector<Point2> vertices;
  std::string name = {};  // of a keep-out area, as of core/types/keep_out.h

  friend bool operator==(const Polygon&, const Polygon&) = default;
};

}  // namespace plumescout
