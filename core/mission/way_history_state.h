// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "core/gas/reading_state.h"
#include "core/mission/way_history.h"
#include "core/occupancy/occupancy_state.h"
#include "core/types/visit_types.h"

namespace plumescout {

void Visit(auto& archive, ConstOr<GasReading> auto& reading) {
  auto& [concentration_ppm, variance_ppm2, sensor] = reading;
  archive(concentration_ppm, variance_ppm2, sensor);
}
void Visit(auto& archive, ConstOr<WayPoint> auto& point) {
  auto& [time_ns, pose] = point;
  archive(time_ns, pose);
}

template <typename Archive, typename Self>
void WayHistory::KeptReading::VisitState(Archive& archive, Self& self) {
  auto& [number, time_ns, pose, reading, quarantined, species, robot_from_sensor, sensor,
         offset_stddev_ppm, is_part] = self;
  // The species is written for missions of several only, see below.
  archive(number, time_ns, pose, reading, quarantined, robot_from_sensor, sensor,
          offset_stddev_ppm);
  archive.Since(2, is_part);
}

template <typename Archive, typename Self>
void WayHistory::KeptScan::VisitState(Archive& archive, Self& self) {
  auto& [number, time_ns, pose, times, last, quarantined, scan] = self;
  archive(number, time_ns, pose, times, last, quarantined, scan);
}

template <typename Archive, typename Self>
void WayHistory::Way::VisitState(Archive& archive, Self& self) {
  auto& [readings, scans, latest, merged_ns, key_scan_closed] = self;
  archive(readings, scans, latest, merged_ns, key_scan_closed);
}

// What only missions of several gases have.
template <typename Archive, typename Self>
void WayHistory::VisitSpecies(Archive& archive, Self& self) {
  for (std::size_t i = 1; i < self.base_readings_.size(); ++i) archive(self.base_readings_[i]);
  for (auto& [robot, way] : self.ways_) {
    for (auto& entry : way.readings) archive(entry.species);
  }
  if constexpr (!Archive::kHashes) {
    for (std::size_t i = 1; i < self.base_sampled_.size(); ++i) archive(self.base_sampled_[i]);
  }
}

template <typename Archive, typename Self>
void WayHistory::VisitState(Archive& archive, Self& self) {
  archive(self.keeps_, self.next_number_, self.used_, self.merged_ns_, self.ways_);
  bool has_base = self.base_map_.has_value();
  archive(has_base);
  if constexpr (Archive::kReads) {
    self.base_map_.reset();
    if (has_base) self.base_map_.emplace(self.occupancy_);
  }
  if (self.base_map_) archive(*self.base_map_);
  archive(self.base_readings_.front(), self.base_sampled_.front());
  if (self.base_readings_.size() > 1) VisitSpecies(archive, self);
  if constexpr (Archive::kReads) {
    archive.Require(self.IsWhole(), "what is kept of robots' ways is damaged");
    if (!archive.ok()) return;
    for (ReadingStore& readings : self.base_readings_) readings = readings.Unplaced();
    self.bytes_ = 0;
    for (const auto& [robot, way] : self.ways_) {
      self.bytes_ += self.BytesOf(way);
    }
  }
}

}  // namespace plumescout
