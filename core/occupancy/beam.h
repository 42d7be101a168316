// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/pose2.h"

namespace plumescout {

// A beam of a scan, in frame map.
struct Beam {
  Point2 end;
  bool hit = false;  // it returned from there

  friend bool operator==(const Beam&, const Beam&) = default;
};

// Moves the ends of beams that returned `depth_m` on along the normal of the surface they came
// from, away from the sensor. The surface is the line through the next ends on both sides, or
// through the one of them that is not farther than kMostGap_m; without such an end it is not known,
// and the beam stays. Where faces lie on the edges of cells, noise puts the ends of beams that
// graze them into the free cells before them (docs/decisions/0034-returns-behind-their-surface.md).
// `beams`: in the order of their angles. Cost: O(beams).
inline constexpr double kMostGap_m = 1.0;
void PutBehindSurfaces(Point2 sensor, double depth_m, std::vector<Beam>& beams);

}  // namespace plumescout
