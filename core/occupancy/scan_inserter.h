// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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
// which a beam ends counts as hit even if other beams pass it. Beams without return clear up to
// max_range_m. NaN, non-positive and too long ranges are dropped one by one. A beam that ends in a
// mask disc is dropped whole.
//
// Errors: kResourceExhausted if the grid would have to grow beyond its limits; nothing changes.
// Cost: O(cells crossed). Thread-compatible: keeps scratch memory between calls.
class ScanInserter {
 public:
  absl::Status Insert(const Pose2& sensor_pose, const Scan& scan,
                      const std::vector<MaskDisc>& masks, OccupancyGrid& grid);

 private:
  std::vector<Cell> hits_;
  std::vector<Cell> passes_;
  Grid<std::uint8_t> touched_;  // 0 no, 1 passed, 2 hit; all 0 between calls
};

}  // namespace plumescout
