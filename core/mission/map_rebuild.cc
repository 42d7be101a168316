// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/map_rebuild.h"

#include <utility>

#include "core/occupancy/scan_inserter.h"

namespace plumescout {
namespace {

constexpr std::int64_t kLeastTime_ns = 1'000'000'000;
constexpr std::int64_t kTimeOfScan_ns = 300'000;

}  // namespace

void InsertAll(const std::vector<PlacedScan>& scans, const StopFn& stop, OccupancyGrid& grid) {
  ScanInserter inserter;
  for (const PlacedScan& placed : scans) {
    if (stop && stop()) return;
    inserter.Insert(placed.pose, Unpack(*placed.scan), placed.scan->masks, grid, placed.times)
        .IgnoreError();
  }
}

MapRebuild::MapRebuild(RebuildInputs inputs)
    : due_ns_(inputs.time_ns + kLeastTime_ns +
              kTimeOfScan_ns * static_cast<std::int64_t>(inputs.scans.size())),
      inputs_(std::move(inputs)) {}

void MapRebuild::Recompute() {
  if (done_) return;
  // Begun from the base again, should it have been stopped before.
  OccupancyGrid grid = inputs_.base;
  InsertAll(inputs_.scans, inputs_.stop, grid);
  if (inputs_.stop && inputs_.stop()) return;
  inputs_.base = std::move(grid);
  inputs_.scans.clear();
  done_ = true;
}

}  // namespace plumescout
