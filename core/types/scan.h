// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/pose2.h"

namespace plumescout {

// Planar range scan. Beam i points along pose yaw + start_angle_rad + i * angle_step_rad.
// A range of +infinity means: nothing seen up to max_range_m. NaN means: the sensor says nothing.
struct Scan {
  double start_angle_rad = 0.0;
  double angle_step_rad = 0.0;
  double max_range_m = 0.0;
  std::vector<float> ranges_m = {};

  friend bool operator==(const Scan&, const Scan&) = default;
};

}  // namespace plumescout
