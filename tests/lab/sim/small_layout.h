// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/sim/layout.h"

namespace plumescout::lab {

// A room of 4 m x 3 m with an inlet in the west, an outlet in the east, a box in the middle and a
// source of 1000 ppm/s.
inline Layout SmallLayout() {
  Layout layout;
  layout.name = "small";
  layout.size_x_m = 4.0;
  layout.size_y_m = 3.0;
  layout.boxes = {{{1.8, 1.2}, {2.2, 1.8}}};
  layout.openings = {{Side::kWest, 1.0, 2.0, 1.0}, {Side::kEast, 1.0, 2.0, std::nullopt}};
  layout.sources = {{0, 1.05, 1.55, 0.4, 1000.0}};
  layout.start_pose = {3.0, 0.5, 0.0};
  return layout;
}

}  // namespace plumescout::lab
