// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// What a history takes, and what becomes of what is oldest when that is too much.
#include "core/mission/way_history.h"

#include <algorithm>
#include <utility>

#include "core/mission/memory_estimate.h"

namespace plumescout {
namespace {

constexpr std::int64_t kBaseCellBytes = 5;
constexpr std::int64_t kMergedParts = 8;  // an eighth of the entries at a time

}  // namespace

std::int64_t WayHistory::base_map_bytes() const {
  return base_map_ ? kBaseCellBytes * static_cast<std::int64_t>(base_map_->geometry().size()) : 0;
}

std::int64_t WayHistory::base_bytes() const {
  if (!base_map_) return 0;
  std::int64_t bytes = base_map_bytes();
  for (const ReadingStore& readings : base_readings_) bytes += ReadingBytes(readings);
  return bytes;
}

std::int64_t WayHistory::BytesOf(const Way& way) {
  std::int64_t bytes = 0;
  for (const KeptReading& entry : way.readings) bytes += entry.bytes();
  for (const KeptScan& entry : way.scans) bytes += kScanBytes + entry.scan->bytes();
  return bytes;
}

std::int64_t WayHistory::OldestNumber() const {
  std::int64_t oldest = next_number_;
  for (const auto& [robot, way] : ways_) {
    if (!way.readings.empty()) oldest = std::min(oldest, way.readings.front().number);
    if (!way.scans.empty()) oldest = std::min(oldest, way.scans.front().number);
  }
  return oldest;
}

void WayHistory::Trim(std::int64_t most_bytes) {
  // The map that scans are merged into only grows: once that alone is too much, no merging helps.
  while (bytes_ > 0 && bytes() > most_bytes && base_map_bytes() <= most_bytes) {
    const std::int64_t oldest = OldestNumber();
    Merge(oldest + 1 + (next_number_ - oldest) / kMergedParts, most_bytes);
  }
  if (bytes() > most_bytes) GiveUp();
}

// What was merged is too much as well.
void WayHistory::GiveUp() {
  keeps_ = false;
  bytes_ = 0;
  ways_.clear();
  base_map_.reset();
  base_readings_ = NoReadings();
  base_sampled_ = NothingSampled();
}

// What is in quarantine is lost, and all the rest once the map takes more than `most_bytes`.
void WayHistory::Merge(std::int64_t below_number, std::int64_t most_bytes) {
  if (!base_map_) base_map_ = Base();
  std::vector<std::pair<std::int64_t, PlacedScan>> scans;
  for (auto& [robot, way] : ways_) {
    std::int64_t& merged_ns = way.merged_ns;
    std::erase_if(way.readings, [&](const KeptReading& entry) {
      if (entry.number >= below_number) return false;
      merged_ns = std::max(merged_ns, entry.time_ns);
      bytes_ -= entry.bytes();
      if (entry.quarantined) return true;
      base_readings_[entry.species].Add(entry.time_ns, entry.place(), entry.reading, entry.is_part);
      base_sampled_[entry.species].Add(entry.time_ns, entry.place());
      return true;
    });
    std::erase_if(way.scans, [&](const KeptScan& entry) {
      if (entry.number >= below_number) return false;
      merged_ns = std::max(merged_ns, entry.time_ns);
      bytes_ -= kScanBytes + entry.scan->bytes();
      if (!entry.quarantined)
        scans.push_back({entry.number, {entry.pose, entry.times, entry.scan}});
      return true;
    });
    if (way.scans.empty()) way.key_scan_closed = true;
  }
  std::sort(scans.begin(), scans.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PlacedScan> placed;
  placed.reserve(scans.size());
  for (auto& [at, scan] : scans) placed.push_back(std::move(scan));
  InsertAll(
      placed, [&] { return base_map_bytes() > most_bytes; }, *base_map_);
}

}  // namespace plumescout
