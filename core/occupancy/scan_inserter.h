// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "absl/status/status.h"
#include "core/occupancy/beam.h"
#include "core/occupancy/occupancy_grid.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout {

// A disc in which beams must not end: another robot, which is not a wall.
struct MaskDisc {
  Point2 center;
  double radius_m = 0.0;

  friend bool operator==(const MaskDisc&, const MaskDisc&) = default;
};

// Whether the point lies in one of them.
bool IsMasked(Point2 point, const std::vector<MaskDisc>& masks);

// Inserts a scan taken at `sensor_pose` (frame map). Each cell changes once per scan; a cell in
// which a beam ends counts as hit even if other beams pass it; the cell under the sensor is passed.
// Beams without return clear up to max_range_m. NaN, non-positive and too long ranges are dropped
// one by one. A beam that ends in a mask disc is dropped whole. A scan of dropped beams is no scan:
// nothing changes. A scan may stand for several of the same place, `times` >= 1: as if it had been
// inserted so often. Hits lie behind their surface by the option surface_depth_m (beam.h), at most
// half a cell, so that none goes through a wall of one.
//
// Errors, with nothing changed: kResourceExhausted if any beam would make the grid grow beyond its
// limits; kInvalidArgument if the pose, an angle or max_range_m is not finite, or that not > 0, or
// if all beams together cross more than kMostCrossings cells.
// Cost: O(cells crossed), 20 ms at most. Thread-compatible: keeps scratch memory between calls.
class ScanInserter {
 public:
  // Each cell counted as often as beams cross it: 1570 beams of 100 m in cells of 0.1 m.
  static constexpr double kMostCrossings = 2e6;

  absl::Status Insert(const Pose2& sensor_pose, const Scan& scan,
                      const std::vector<MaskDisc>& masks, OccupancyGrid& grid, int times = 1);

 private:
  // The beams of `scan` that say something, into beams_.
  void KeepBeams(const Pose2& sensor_pose, const Scan& scan, const std::vector<MaskDisc>& masks);
  absl::Status CheckCrossings(Point2 sensor, double resolution_m) const;
  void MarkPassed(std::size_t index);
  // Changes the cells that are marked in [first, last], and unmarks them. Row by row: in the order
  // of memory it takes a fraction of the time.
  void Apply(Cell first, Cell last, OccupancyGrid& grid, int times);

  std::vector<Beam> beams_;
  Grid<std::uint8_t> touched_;  // 0 no, 1 passed, 2 hit; all 0 between calls
};

}  // namespace plumescout
