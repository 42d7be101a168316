// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/disc_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumescout::lab {
namespace {

constexpr int kRings = 4;
constexpr int kDirections = 12;
constexpr double kFirstRing = 2.4;  // of the radius: clear of a disc on the place itself
constexpr double kRingStep = 1.6;

// From the nearest to the farthest.
std::vector<PixelPoint> Offsets(double radius_px) {
  std::vector<PixelPoint> offsets = {{0.0, 0.0}};
  for (int ring = 0; ring < kRings; ++ring) {
    const double distance_px = radius_px * (kFirstRing + ring * kRingStep);
    for (int i = 0; i < kDirections; ++i) {
      const double angle_rad = 2.0 * std::numbers::pi * i / kDirections;
      offsets.push_back({distance_px * std::cos(angle_rad), -distance_px * std::sin(angle_rad)});
    }
  }
  return offsets;
}

bool LiesIn(PixelPoint center, double radius_px, const PixelBox& bounds) {
  return center.x - radius_px >= bounds.x && center.x + radius_px <= bounds.right() &&
         center.y - radius_px >= bounds.y && center.y + radius_px <= bounds.bottom();
}

}  // namespace

std::vector<PixelPoint> SpreadDiscs(std::span<const PixelPoint> places, double radius_px,
                                    const PixelBox& bounds) {
  const std::vector<PixelPoint> offsets = Offsets(radius_px);
  std::vector<PixelPoint> centers;
  for (const PixelPoint& place : places) {
    PixelPoint chosen = place;
    for (const PixelPoint& offset : offsets) {
      const PixelPoint center{place.x + offset.x, place.y + offset.y};
      const bool free = std::none_of(centers.begin(), centers.end(), [&](PixelPoint other) {
        return std::hypot(other.x - center.x, other.y - center.y) < 2.0 * radius_px;
      });
      if (!free || !LiesIn(center, radius_px, bounds)) continue;
      chosen = center;
      break;
    }
    centers.push_back(chosen);
  }
  return centers;
}

}  // namespace plumescout::lab
