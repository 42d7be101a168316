// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "absl/status/status.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"
#include "core/types/rng.h"
#include "core/types/scan.h"

namespace plumescout::lab {

struct LidarOptions {
  int beams = 360;              // evenly around, the first one backwards, [1, 20000]
  double max_range_m = 8.0;     // (0, 100]
  double noise_sigma_m = 0.02;  // [0, 1]
  double dropout_share = 0.0;   // of beams, drawn anew in every scan, that say nothing, [0, 1]
};

// kInvalidArgument naming field, value and range.
absl::Status Validate(const LidarOptions& options);

// Exact distance from `from` along `angle_rad` (frame map) to what a beam sees, metres; +infinity
// if the first occupied cell begins beyond `max_range_m` or there is none.
//
// The return comes from the middle of the beam's way through that cell, not from its edge: an
// occupied cell says that there is a surface in it, not where, and a return from the edge would,
// with the slightest noise, count for the free cell in front of it half of the time.
// Cost: O(cells crossed).
double CastBeam_m(const Grid<CellState>& truth, Point2 from, double angle_rad, double max_range_m);

// What beams hit besides the map: another robot.
struct Body {
  Point2 center;
  double radius_m = 0.0;

  friend bool operator==(const Body&, const Body&) = default;
};

// The least distance along `angle_rad` from `from` to a body's edge, metres; +infinity if none is
// hit. A body around `from` is not seen: it is the sensor's own.
double CastBeamAtBodies_m(const std::vector<Body>& bodies, Point2 from, double angle_rad);

// Planar range finder in a true map. Beams that hit nothing return +infinity; beams that drop out
// return NaN, which is no word of free space.
class Lidar {
 public:
  // REQUIRES: valid options.
  Lidar(const LidarOptions& options, std::uint64_t seed);

  Scan Take(const Grid<CellState>& truth, const Pose2& pose, const std::vector<Body>& bodies = {});

 private:
  LidarOptions options_;
  Rng rng_;
};

}  // namespace plumescout::lab
