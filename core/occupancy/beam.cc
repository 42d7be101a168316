// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/occupancy/beam.h"

#include <cmath>
#include <cstddef>

namespace plumescout {
namespace {

bool AreOfOneSurface(const Beam& a, const Beam& b) {
  return a.hit && b.hit && Distance_m(a.end, b.end) <= kMostGap_m;
}

// Of length depth_m along the normal of the line from `from` to `to`, to the side that `direction`
// leads to; zero if they are one point.
Point2 StepBehind(Point2 from, Point2 to, Point2 direction, double depth_m) {
  const double length_m = Distance_m(from, to);
  if (length_m == 0.0) return {0.0, 0.0};
  const Point2 normal{(from.y_m - to.y_m) / length_m, (to.x_m - from.x_m) / length_m};
  const bool away = normal.x_m * direction.x_m + normal.y_m * direction.y_m >= 0.0;
  const double step_m = away ? depth_m : -depth_m;
  return {step_m * normal.x_m, step_m * normal.y_m};
}

}  // namespace

void PutBehindSurfaces(Point2 sensor, double depth_m, std::vector<Beam>& beams) {
  Beam before;  // as it was told; none before the first
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const Beam told = beams[i];
    const bool has_before = AreOfOneSurface(before, told);
    const bool has_after = i + 1 < beams.size() && AreOfOneSurface(told, beams[i + 1]);
    const Point2 from = has_before ? before.end : told.end;
    const Point2 to = has_after ? beams[i + 1].end : told.end;
    const Point2 direction{told.end.x_m - sensor.x_m, told.end.y_m - sensor.y_m};
    const Point2 step = StepBehind(from, to, direction, depth_m);
    beams[i].end = {told.end.x_m + step.x_m, told.end.y_m + step.y_m};
    before = told;
  }
}

}  // namespace plumescout
