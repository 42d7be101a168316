// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/anchored_states.h"
#include "core/gas/field/cell_input.h"
#include "core/gas/gas_lattice.h"
#include "core/gas/reading_store.h"
#include "core/gas/sensor_offsets.h"
#include "core/types/options.h"

namespace plumescout {

// All that a gas field is told, by gas cell: which cells are free, how they are linked, and what
// the readings in them say.
class GasInputs {
 public:
  // `resolution_m`: as of ReadingStore.
  explicit GasInputs(const GasOptions& options, double resolution_m = 0.0);
  // With readings that are not placed yet.
  GasInputs(const GasOptions& options, ReadingStore readings, SensorOffsets sensors);

  void Add(std::int64_t time_ns, Point2 position, const GasReading& reading, bool is_part = false) {
    readings_.Add(time_ns, position, reading, is_part);
  }
  // The same of a sensor in a mission in which some have unknown offsets.
  void AddFrom(const ReadingSource& source, std::int64_t time_ns, Point2 position,
               const GasReading& reading) {
    Add(time_ns, position, reading);
    sensors_.Add(source, time_ns, position, reading, readings_.anchor());
  }
  const SensorOffsets& sensors() const { return sensors_; }
  const GasCounters& counters() const { return readings_.counters(); }
  const ReadingStore& readings() const { return readings_; }
  // Whether a reading there has a free cell, or may wait for one; see ReadingStore::HasRoomFor.
  bool HasRoomFor(Point2 position) const;

  // Takes over the map, places readings on it, and ages those alone that an epoch would age too
  // late (see AgeingWatch). Returns the gas cells of which Of may have changed, ascending, each
  // once.
  // Errors, with nothing changed: those of AnchoredStates::Update. Cost: O(cells) to compare maps.
  absl::StatusOr<std::vector<GasCell>> Update(const Grid<CellState>& states, std::int64_t time_ns);

  // Cost: O(factor()^2) lookups, and the buckets of the readings in the cell.
  CellInput Of(GasCell cell) const;
  // Of all cells of the lattice. REQUIRES: it holds rect(). Cost: O(cells), and all buckets.
  std::vector<CellInput> On(const GasLattice& lattice) const;
  const AnchoredStates& states() const { return states_; }
  // Holds all gas cells that ever were active.
  const GasCellRect& rect() const { return rect_; }
  int factor() const { return factor_; }
  // Doubles the factor, unless it would be beyond kMostLatticeFactor. Returns whether it did. Gas
  // cells are others then.
  bool Coarsen();
  bool CanCoarsen() const { return 2 * factor_ <= kMostLatticeFactor; }
  const AgeingWatch& watch() const { return readings_.watch(); }
  // What Of says of readings, by anchor cell.
  std::vector<CellEvidence> AllEvidence() const { return readings_.AllEvidence(); }

  // Merges readings of so nearly the same age that it makes no difference, and says what all would
  // say after AgeTo(time_ns): evidence only, cells ascending. Nothing without ageing.
  std::vector<std::pair<GasCell, Evidence>> EvidenceAsOf(std::int64_t time_ns);
  // From now on Of says so; returns the cells of which it does. For cells without news since
  // EvidenceAsOf(time_ns) it is the same to the bit.
  std::vector<GasCell> AgeTo(std::int64_t time_ns);

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  bool RectHoldsFreeCells() const;
  std::map<GasCell, Evidence> SumsOf(std::span<const CellEvidence> cells) const;
  std::vector<GasCell> GasCellsOf(std::span<const AnchorCell> cells) const;

  int factor_;
  bool ages_;
  ReadingStore readings_;
  SensorOffsets sensors_;
  AnchoredStates states_;
  GasCellRect rect_;
};

}  // namespace plumescout
