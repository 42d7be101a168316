// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/reading_store.h"
#include "core/gas/sensor_crossings.h"
#include "core/types/gas_sensor.h"
#include "core/types/options.h"

namespace plumescout {

// Which sensor of a mission took a reading.
struct ReadingSource {
  RobotId robot;
  std::string sensor;
  double offset_stddev_ppm = 0.0;  // see GasSensor
};

// The readings of sensors with unknown offsets, once more by sensor, and where sensors met. Offsets
// are to be estimated for those alone that met others often enough: of one whose ways cross
// nobody's the field itself cannot be told from an offset, and taking one off does harm. Readings
// do not age here: REQUIRES options without ageing. Thread-compatible.
class SensorOffsets {
 public:
  SensorOffsets(const GasOptions& options, double resolution_m)
      : options_(options), resolution_m_(resolution_m) {}

  // The same that the field hears. `anchor`: of the cells of the field, none if it has none yet.
  void Add(const ReadingSource& source, std::int64_t time_ns, Point2 position,
           const GasReading& reading, const GridGeometry& anchor);
  // As ReadingStore::Place, with the same arguments.
  absl::Status Place(const Grid<CellState>& states, std::span<const std::size_t> changed);

  // A sensor whose offset is to be estimated.
  struct Column {
    std::size_t sensor = 0;           // index into Known()
    std::vector<CellEvidence> cells;  // ascending
    double prior_precision_per_ppm2 = 0.0;
  };
  // Of as many as a whole team has with one each: a column takes a pass over the factor, and a
  // number in each cell of the lattice. Of others, that were heard later, the offset stays unknown.
  static constexpr std::size_t kMostColumns = 32;
  // Cost: that of their readings.
  std::vector<Column> Columns() const;
  bool HasColumns() const;

  // All with an unknown offset, in the order in which they were first heard, without estimates.
  std::vector<SensorOffset> Known() const;

  // Nothing was read.
  bool empty() const { return sensors_.empty(); }
  // Besides those of the field.
  std::size_t sites() const;
  std::size_t buckets() const;

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);
  // As ReadingStore::PlaceAgain.
  bool PlaceAgain(const AnchoredStates& states);

 private:
  struct Sensor {
    ReadingSource source;
    ReadingStore readings;  // none of a calibrated one
  };

  std::size_t Find(const ReadingSource& source, const GridGeometry& anchor);
  bool IsColumn(std::size_t sensor) const;

  GasOptions options_;
  double resolution_m_;
  std::vector<Sensor> sensors_;
  SensorCrossings crossings_;  // of sensors by their place among those
};

}  // namespace plumescout
