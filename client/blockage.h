// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout::client {

struct BlockageOptions {
  double radius_m = 0.2;  // of the robot
  // Walls on the map are blurred by a cell's diagonal, so a path that keeps the radius on the map
  // may rightly pass this much nearer to what the scan sees.
  double map_blur_m = 0.15;
  double min_clearance_m = 0.05;  // nearer than this is blocked, however small the robot
  // So much more at the end of the path, which is the centre of a cell, and not as near to walls on
  // the map as the way there may be. Beyond a frontier there may be a wall that is not on the map.
  double end_margin_m = 0.05;
  double range_noise_m = 0.05;  // 2.5 sigma of a usual lidar
  double lookahead_m = 0.8;     // of the path, from the robot on
  int min_beams = 2;            // one beam alone may be a glitch
};

// Whether driving on would bring the robot into what the scan sees: enough beams end nearer to the
// next stretch of the path than the radius, less the blur of the map, or a little farther from its
// end. Beam ends that are as near to the robot already do not count unless the path leads closer to
// them. `path_ahead` begins where the robot stands.
// Cost: O(beams * segments in the lookahead).
bool PathBlocked(const Scan& scan, const Pose2& scan_pose, const std::vector<Point2>& path_ahead,
                 const BlockageOptions& options);

}  // namespace plumescout::client
