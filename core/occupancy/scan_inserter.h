// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "absl/status/status.h"
#include "core/occupancy/occupancy_grid.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout {

// A disc in which beams must not end: another robot, which is not a wall.
struct MaskDisc {
  Point2 center;
  double radius_m = 0.0;
};

// Inserts a scan taken at `sensor_pose` (frame map). Each cell changes once per scan; a cell in
// which a beam ends counts as hit even if other beams pass it; the cell under the sensor is passed.
// Beams without return clear up to max_range_m. NaN, non-positive and too long ranges are dropped
// one by one. A beam that ends in a mask disc is dropped whole. A scan of dropped beams is no scan:
// nothing changes.
//
// Errors, with nothing changed: kResourceExhausted if any beam would make the grid grow beyond its
// limits; kInvalidArgument if the pose, an angle or max_range_m is not finite, or that not > 0.
// Cost: O(cells crossed). Thread-compatible: keeps scratch memory between calls.
class ScanInserter {
 public:
  absl::Status Insert(const Pose2& sensor_pose, const Scan& scan,
                      const std::vector<MaskDisc>& masks, OccupancyGrid& grid);

 private:
  struct Beam {
    Point2 end;
    bool hit = false;
  };

  // The beams of `scan` that say something, into beams_.
  void KeepBeams(const Pose2& sensor_pose, const Scan& scan, const std::vector<MaskDisc>& masks);
  void MarkHit(std::size_t index);
  void MarkPassed(std::size_t index);
  void Apply(OccupancyGrid& grid);

  std::vector<Beam> beams_;
  std::vector<std::size_t> hits_;    // indices of cells
  std::vector<std::size_t> passes_;  // likewise, none of them hit
  Grid<std::uint8_t> touched_;       // 0 no, 1 passed, 2 hit; all 0 between calls
};

}  // namespace plumescout
