// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/sensor_offsets.h"

#include <algorithm>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout {

std::size_t SensorOffsets::Find(const ReadingSource& source, const GridGeometry& anchor) {
  const auto found = std::find_if(sensors_.begin(), sensors_.end(), [&](const Sensor& sensor) {
    return sensor.source.robot == source.robot && sensor.source.sensor == source.sensor;
  });
  if (found != sensors_.end()) {
    found->source.offset_stddev_ppm = source.offset_stddev_ppm;
    return static_cast<std::size_t>(found - sensors_.begin());
  }
  sensors_.push_back({source, ReadingStore(options_, resolution_m_)});
  // Its cells are to be those of the field.
  if (anchor.size() > 0) {
    sensors_.back().readings.Place(Grid<CellState>(anchor, CellState::kUnknown), {}).IgnoreError();
  }
  return sensors_.size() - 1;
}

void SensorOffsets::Add(const ReadingSource& source, std::int64_t time_ns, Point2 position,
                        const GasReading& reading, const GridGeometry& anchor) {
  const std::size_t sensor = Find(source, anchor);
  // Two of one robot always meet; if neither is calibrated, that tells nothing of their offsets but
  // the difference.
  const auto tells = [&](int other) {
    const ReadingSource& another = sensors_[static_cast<std::size_t>(other)].source;
    return another.robot != source.robot || another.offset_stddev_ppm == 0.0 ||
           source.offset_stddev_ppm == 0.0;
  };
  crossings_.Add(static_cast<int>(sensor), time_ns, position, reading.concentration_ppm, tells);
  if (source.offset_stddev_ppm > 0.0) sensors_[sensor].readings.Add(time_ns, position, reading);
}

absl::Status SensorOffsets::Place(const Grid<CellState>& states,
                                  std::span<const std::size_t> changed) {
  for (Sensor& sensor : sensors_) {
    PLUMESCOUT_RETURN_IF_ERROR(sensor.readings.Place(states, changed));
    sensor.readings.TakeChanged();
  }
  return absl::OkStatus();
}

bool SensorOffsets::IsColumn(std::size_t sensor) const {
  return sensors_[sensor].source.offset_stddev_ppm > 0.0 &&
         crossings_.IsLinked(static_cast<int>(sensor));
}

bool SensorOffsets::HasColumns() const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (IsColumn(i)) return true;
  }
  return false;
}

std::vector<SensorOffsets::Column> SensorOffsets::Columns() const {
  std::vector<Column> columns;
  std::size_t known = 0;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const double stddev_ppm = sensors_[i].source.offset_stddev_ppm;
    if (stddev_ppm <= 0.0) continue;
    if (IsColumn(i) && columns.size() < kMostColumns) {
      columns.push_back(
          {known, sensors_[i].readings.AllEvidence(), 1.0 / (stddev_ppm * stddev_ppm)});
    }
    ++known;
  }
  return columns;
}

std::vector<SensorOffset> SensorOffsets::Known() const {
  std::vector<SensorOffset> known;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const ReadingSource& source = sensors_[i].source;
    if (source.offset_stddev_ppm <= 0.0) continue;
    const int sensor = static_cast<int>(i);
    SensorOffset offset;
    offset.robot = source.robot;
    offset.sensor = source.sensor;
    offset.stddev_ppm = source.offset_stddev_ppm;
    offset.crossings = crossings_.Count(sensor);
    offset.drifting = crossings_.IsDrifting(sensor, 0.5 * source.offset_stddev_ppm);
    known.push_back(std::move(offset));
  }
  return known;
}

std::size_t SensorOffsets::sites() const {
  std::size_t sites = 0;
  for (const Sensor& sensor : sensors_)
    sites += sensor.readings.sites() + sensor.readings.arrivals();
  return sites;
}

std::size_t SensorOffsets::buckets() const {
  std::size_t buckets = 0;
  for (const Sensor& sensor : sensors_) buckets += sensor.readings.buckets();
  return buckets;
}

bool SensorOffsets::PlaceAgain(const AnchoredStates& states) {
  return std::all_of(sensors_.begin(), sensors_.end(),
                     [&](Sensor& sensor) { return sensor.readings.PlaceAgain(states); });
}

}  // namespace plumescout
