// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/gas/reading_store.h"
#include "core/types/options.h"

namespace plumescout {

// Measured costs of what a mission holds (lab/bench/outdoor_bench, docs/performance.md): with the
// snapshots of it that readers keep, and what is needed for a moment while it changes.
inline constexpr std::int64_t kMissionBytes = std::int64_t{8} << 20;  // with its queues
inline constexpr std::int64_t kMapCellBytes = 64;
// Of every gas beside the first: rasters of its mean and variance, and those of snapshots.
inline constexpr std::int64_t kFurtherGasCellBytes = 32;
inline constexpr std::int64_t kReadingSiteBytes = 500;
inline constexpr std::int64_t kReadingBucketBytes = 290;
inline constexpr std::int64_t kVisitedTileBytes = 80;
// Of a sensor that lags, at most: 256 points of its way and as many stays in cells, with what
// vectors reserve.
inline constexpr std::int64_t kWayBytes = std::int64_t{64} << 10;

// What a mission holds, in the units in which its memory is reckoned. It follows from the events
// alone, so that what is refused for want of memory does too.
struct MemoryUse {
  std::int64_t map_cells = 0;
  std::int64_t reading_sites = 0;
  std::int64_t reading_buckets = 0;
  std::int64_t visited_tiles = 0;
  std::int64_t field_bytes = 0;  // of all fields; see core/gas/field_bytes.h
  std::int64_t species = 1;      // gases that are mapped
  std::int64_t ways = 0;         // of sensors that lag

  std::int64_t CellBytes() const { return kMapCellBytes + kFurtherGasCellBytes * (species - 1); }
  std::int64_t BesideField_bytes() const {
    return kMissionBytes + CellBytes() * map_cells + kReadingSiteBytes * reading_sites +
           kReadingBucketBytes * reading_buckets + kVisitedTileBytes * visited_tiles +
           kWayBytes * ways;
  }
  std::int64_t Total_bytes() const { return BesideField_bytes() + field_bytes; }
};

// What readings take that are kept beside the field, in the same units. Cost: O(1).
std::int64_t ReadingBytes(const ReadingStore& readings);

// How a budget is shared. The field, or all of them together, may take five eighths of it, or what
// the rest leaves; a coarser lattice always does with less.
std::int64_t RoomForField_bytes(std::int64_t budget_bytes, const MemoryUse& use);
// What may be added beside the field: seven eighths of the budget are for the rest at most, so that
// a coarse field always has room.
std::int64_t RoomBesideField_bytes(std::int64_t budget_bytes, const MemoryUse& use);

// BUDGET_REACHED, kResourceExhausted.
absl::Status BudgetReached(absl::string_view message);

// The options with a gas lattice so coarse that the field of the known map, if there is one, fits
// the budget: of a map that counts as visited, all of it, else what one robot makes of it.
// Errors: BUDGET_REACHED, naming what is needed, if the map does not fit. REQUIRES:
// Validate(options).ok(). Cost: O(cells of the map).
absl::StatusOr<MissionOptions> FitToBudget(const MissionOptions& options);

// Whether a known map of this size counts as visited; see GasOptions::field_reach_m.
bool CountsAsVisited(const GridGeometry& known, const GasOptions& options);

}  // namespace plumescout
