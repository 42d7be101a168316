// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/scene_world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/types/checker.h"

namespace plumescout::lab {
namespace {

constexpr double kMaxAmbient_ppm = 1e6;

// From `point` to the nearest point of the cell's square.
double DistanceToCell_m(Point2 point, Cell cell, const GridGeometry& geometry) {
  const Point2 center = geometry.Center(cell);
  const double half_m = geometry.resolution_m / 2.0;
  const double x_m = std::max(0.0, std::abs(point.x_m - center.x_m) - half_m);
  const double y_m = std::max(0.0, std::abs(point.y_m - center.y_m) - half_m);
  return std::hypot(x_m, y_m);
}

}  // namespace

absl::Status Validate(const SceneWorldOptions& options) {
  return Checker().InRange("world.ambient_ppm", options.ambient_ppm, 0.0, kMaxAmbient_ppm).status();
}

SceneWorld::SceneWorld(Scene scene, const SceneWorldOptions& options)
    : scene_(std::move(scene)), options_(options) {}

double SceneWorld::Concentration_ppm(Point2 point, double time_s) const {
  const double length_s = scene_.series.frames * scene_.series.dt_s;
  // The frame nearest to a time just before the end is the one after the last: the first again.
  const double half_frame_s = scene_.series.dt_s / 2.0;
  const bool past_end = time_s >= length_s - half_frame_s;
  if (options_.series_end == SeriesEnd::kRepeat && past_end) {
    time_s = std::fmod(time_s + half_frame_s, length_s) - half_frame_s;
  }
  return options_.ambient_ppm + SampleConcentration_ppm(scene_, point, time_s);
}

bool SceneWorld::Collides(Point2 center, double radius_m) const {
  const GridGeometry& geometry = scene_.geometry();
  if (occupancy().At(geometry.CellAt(center), CellState::kOccupied) != CellState::kFree)
    return true;
  const Cell low = geometry.CellAt({center.x_m - radius_m, center.y_m - radius_m});
  const Cell high = geometry.CellAt({center.x_m + radius_m, center.y_m + radius_m});
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      const bool solid = occupancy().At({x, y}, CellState::kOccupied) != CellState::kFree;
      if (solid && DistanceToCell_m(center, {x, y}, geometry) <= radius_m) return true;
    }
  }
  return false;
}

}  // namespace plumescout::lab
