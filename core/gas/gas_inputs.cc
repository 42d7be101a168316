// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_inputs.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/types/status_macros.h"

namespace plumescout {
namespace {

using GasCells = std::vector<GasCell>;

void Sort(GasCells::iterator begin, GasCells::iterator end) {
  if (!std::is_sorted(begin, end)) std::sort(begin, end);
}

// Ascending, each once. Cells from `middle` on are by the map: mostly many, and ascending already.
void SortOnce(GasCells& cells, std::size_t middle) {
  const auto map = cells.begin() + static_cast<std::ptrdiff_t>(middle);
  Sort(cells.begin(), map);
  Sort(map, cells.end());
  std::inplace_merge(cells.begin(), map, cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

}  // namespace

GasInputs::GasInputs(const GasOptions& options, double resolution_m)
    : GasInputs(options, ReadingStore(options, resolution_m),
                SensorOffsets(options, resolution_m)) {}

GasInputs::GasInputs(const GasOptions& options, ReadingStore readings, SensorOffsets sensors)
    : factor_(options.lattice_factor),
      ages_(Ageing(options).enabled()),
      readings_(std::move(readings)),
      sensors_(std::move(sensors)) {}

bool GasInputs::HasRoomFor(Point2 position) const {
  if (readings_.HasRoomFor(position)) return true;
  if (states_.empty()) return false;
  const Cell cell = states_.states().geometry().CellAt(position);
  return states_.states().At(cell, CellState::kUnknown) == CellState::kFree;
}

bool GasInputs::Coarsen() {
  constexpr int kTwice = 2;
  if (!CanCoarsen()) return false;
  factor_ *= kTwice;
  if (rect_.empty()) return true;
  const GasCell low = GasCellOf({rect_.min.x, rect_.min.y}, kTwice);
  const GasCell high = GasCellOf({rect_.end.x - 1, rect_.end.y - 1}, kTwice);
  rect_ = {low, {high.x + 1, high.y + 1}};
  return true;
}

absl::StatusOr<std::vector<GasCell>> GasInputs::Update(const Grid<CellState>& states,
                                                       std::int64_t time_ns) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<std::size_t> freed, states_.Update(states));
  PLUMESCOUT_RETURN_IF_ERROR(readings_.Place(states_.states(), freed));
  PLUMESCOUT_RETURN_IF_ERROR(sensors_.Place(states_.states(), freed));
  std::vector<GasCell> changed = GasCellsOf(readings_.TakeChanged());
  readings_.AgeStale(time_ns);
  for (const GasCell cell : GasCellsOf(readings_.TakeChanged())) changed.push_back(cell);
  const std::size_t by_readings = changed.size();
  changed.reserve(by_readings + freed.size());
  for (const std::size_t index : freed) {
    const GasCell gas_cell = GasCellOf(states_.At(index), factor_);
    changed.push_back(gas_cell);
    if (states_.states()[index] == CellState::kFree) rect_.Include(gas_cell);
    if (factor_ == 1) continue;
    // The links to it belong to its neighbours west and south.
    changed.push_back({gas_cell.x - 1, gas_cell.y});
    changed.push_back({gas_cell.x, gas_cell.y - 1});
  }
  SortOnce(changed, by_readings);
  return changed;
}

bool GasInputs::RectHoldsFreeCells() const {
  const Grid<CellState>& states = states_.states();
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] != CellState::kFree) continue;
    if (!rect_.Contains(GasCellOf(states_.At(i), factor_))) return false;
  }
  return true;
}

CellInput GasInputs::Of(GasCell cell) const {
  CellInput input = StructureOf(states_, cell, factor_);
  if (!input.active) return input;
  Evidence sum;
  for (int y = 0; y < factor_; ++y) {
    for (int x = 0; x < factor_; ++x) {
      sum += readings_.EvidenceAt({cell.x * factor_ + x, cell.y * factor_ + y});
    }
  }
  input.precision = sum.precision;
  input.weighted_deviation = sum.weighted_deviation;
  return input;
}

std::vector<std::pair<GasCell, Evidence>> GasInputs::EvidenceAsOf(std::int64_t time_ns) {
  if (!ages_) return {};
  readings_.Compact(time_ns);
  const std::map<GasCell, Evidence> sums = SumsOf(readings_.EvidenceAsOf(time_ns));
  return {sums.begin(), sums.end()};
}

// A sum for each gas cell of its anchor cells in ascending order, as in Of: the same bits.
std::map<GasCell, Evidence> GasInputs::SumsOf(std::span<const CellEvidence> cells) const {
  std::map<GasCell, Evidence> sums;
  for (const CellEvidence& e : cells) sums[GasCellOf(e.cell, factor_)] += e.evidence;
  return sums;
}

std::vector<CellInput> GasInputs::On(const GasLattice& lattice) const {
  std::vector<CellInput> inputs(lattice.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    inputs[i] = StructureOf(states_, lattice.CellAt(i), factor_);
  }
  for (const auto& [cell, evidence] : SumsOf(readings_.AllEvidence())) {
    CellInput& input = inputs[lattice.Index(cell)];
    if (!input.active) continue;
    input.precision = evidence.precision;
    input.weighted_deviation = evidence.weighted_deviation;
  }
  return inputs;
}

std::vector<GasCell> GasInputs::AgeTo(std::int64_t time_ns) {
  readings_.AgeTo(time_ns);
  return GasCellsOf(readings_.TakeChanged());
}

std::vector<GasCell> GasInputs::GasCellsOf(std::span<const AnchorCell> cells) const {
  std::vector<GasCell> gas_cells;
  gas_cells.reserve(cells.size());
  for (const AnchorCell cell : cells) gas_cells.push_back(GasCellOf(cell, factor_));
  SortOnce(gas_cells, gas_cells.size());
  return gas_cells;
}

}  // namespace plumescout
