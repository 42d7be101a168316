// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/mission/packed_scan.h"
#include "core/occupancy/occupancy_grid.h"
#include "core/types/pose2.h"
#include "core/types/stop.h"

namespace plumescout {

// A kept scan at its corrected place.
struct PlacedScan {
  Pose2 pose;
  int times = 1;  // how many scans it stands for
  std::shared_ptr<const PackedScan> scan;
};

// What is known to be wrong with a map until it is rebuilt. While it misleads, nobody is judged by
// it. Missions are saved with these numbers: before there was a slight fault, any misled.
enum class MapFault : std::uint8_t { kNone = 0, kMisleads = 1, kSlight = 2 };
constexpr bool IsOne(MapFault fault) {
  return fault == MapFault::kNone || fault == MapFault::kMisleads || fault == MapFault::kSlight;
}

// What a rebuild starts from: a mission at one moment.
struct RebuildInputs {
  std::int64_t time_ns = 0;       // of samples
  std::int64_t last_number = 0;   // of what was kept by then
  OccupancyGrid base;             // the known map, and scans that are kept no more
  std::vector<PlacedScan> scans;  // in the order in which they came
  StopFn stop;
  MapFault fault = MapFault::kMisleads;  // of the map that it is to replace
};

// Inserts them, until `stop`, which is asked before each. A scan that the grid has no room for is
// passed over.
void InsertAll(const std::vector<PlacedScan>& scans, const StopFn& stop, OccupancyGrid& grid);

// The map from scratch, with corrected poses: made beside the mission, which goes on meanwhile.
// Shares nothing with it that changes.
class MapRebuild {
 public:
  explicit MapRebuild(RebuildInputs inputs);

  // The long part, 0.06 to 0.3 ms a scan; may run on any thread. Does nothing if it is done, and
  // comes to nothing if `stop` ends it.
  void Recompute();
  bool done() const { return done_; }

  MapFault fault() const { return inputs_.fault; }
  std::int64_t time_ns() const { return inputs_.time_ns; }
  std::int64_t last_number() const { return inputs_.last_number; }
  // When it is adopted, in sample time: a fixed time for what there is to do, so that events do not
  // depend on machines.
  std::int64_t due_ns() const { return due_ns_; }
  // REQUIRES: done().
  OccupancyGrid TakeGrid() { return std::move(inputs_.base); }

 private:
  const std::int64_t due_ns_;
  RebuildInputs inputs_;
  bool done_ = false;
};

}  // namespace plumescout
