// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/anchored_states.h"
#include "core/gas/field/cell_input.h"
#include "core/gas/gas_lattice.h"
#include "core/gas/reading_store.h"
#include "core/types/options.h"

namespace plumescout {

// All that a gas field is told, by gas cell: which cells are free, how they are linked, and what
// the readings in them say.
class GasInputs {
 public:
  explicit GasInputs(const GasOptions& options);

  void Add(std::int64_t time_ns, Point2 position, const GasReading& reading) {
    readings_.Add(time_ns, position, reading);
  }
  const GasCounters& counters() const { return readings_.counters(); }

  // Takes over the map and places readings on it. Returns the gas cells of which Of may have
  // changed, ascending, each once.
  // Errors, with nothing changed: those of AnchoredStates::Update. Cost: O(cells) to compare maps.
  absl::StatusOr<std::vector<GasCell>> Update(const Grid<CellState>& states);

  // Cost: O(factor()^2) lookups, and the buckets of the readings in the cell.
  CellInput Of(GasCell cell) const;
  const AnchoredStates& states() const { return states_; }
  // Holds all gas cells that ever were active.
  const GasCellBox& box() const { return box_; }
  int factor() const { return factor_; }

  // Merges readings of so nearly the same age that it makes no difference, and says what all would
  // say as of `time_ns`: evidence only, cells ascending.
  std::vector<std::pair<GasCell, Evidence>> EvidenceAsOf(std::int64_t time_ns);
  // From now on Of says so; returns the cells of which it does. For cells without news since
  // EvidenceAsOf(time_ns) it is the same to the bit.
  std::vector<GasCell> AgeTo(std::int64_t time_ns);

 private:
  std::vector<GasCell> GasCellsOf(std::span<const AnchorCell> cells) const;

  int factor_;
  ReadingStore readings_;
  AnchoredStates states_;
  GasCellBox box_;
};

}  // namespace plumescout
