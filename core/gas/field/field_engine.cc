// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_engine.h"

#include <algorithm>
#include <cmath>

namespace plumescout {
namespace {

std::shared_ptr<const SeparatorTree> MakeTree(std::size_t width, std::size_t height,
                                              std::span<const CellInput> cells) {
  std::vector<std::uint8_t> active;
  active.reserve(cells.size());
  for (const CellInput& cell : cells) active.push_back(cell.active ? 1 : 0);
  return std::make_shared<SeparatorTree>(width, height, active);
}

absl::Status Check(const CellChange& change, std::size_t cells) {
  if (change.cell >= cells) return absl::InvalidArgumentError("a cell lies beyond the lattice");
  const CellInput& input = change.input;
  const bool usable = input.precision >= 0.0 && input.precision <= kMaxCellPrecision &&
                      std::abs(input.weighted_deviation) <= kMaxCellPrecision;
  if (!usable) return absl::InvalidArgumentError("the evidence of a cell is out of range");
  return absl::OkStatus();
}

}  // namespace

FieldEngine::FieldEngine(std::size_t width, std::size_t height, std::span<const CellInput> cells,
                         const FieldOptions& options)
    : options_(options),
      tree_(MakeTree(width, height, cells)),
      cells_{std::vector<std::uint8_t>(cells.size()), std::vector<double>(cells.size()),
             std::vector<double>(cells.size())},
      builder_(*tree_, options.prior),
      factor_(tree_),
      marginals_(*tree_),
      dirty_(tree_->nodes().size()) {
  for (std::size_t i = 0; i < cells.size(); ++i) Store({i, cells[i]});
  Recompute();
}

absl::Status FieldEngine::Apply(std::span<const CellChange> changes) {
  for (const CellChange& change : changes) {
    const absl::Status status = Check(change, tree_->cells());
    if (!status.ok()) return status;
  }
  if (pending_.size() + changes.size() <= options_.max_pending && AreReadings(changes)) {
    for (const CellChange& change : changes) AddReading(change);
    return absl::OkStatus();
  }
  for (const CellChange& change : changes) {
    MarkChange(change);
    Store(change);
  }
  Refresh();
  return absl::OkStatus();
}

// Whether each change only adds to what is known of its cell, or concerns a cell without variable.
bool FieldEngine::AreReadings(std::span<const CellChange> changes) const {
  return std::all_of(changes.begin(), changes.end(), [this](const CellChange& change) {
    const Slot slot = tree_->slot(change.cell);
    if (change.input.active != (cells_.active[slot] != 0)) return false;
    return !change.input.active || change.input.precision >= cells_.precision[slot];
  });
}

// [IPP] Eq. (3) with one more precision w on the diagonal: for the column x of the covariance in
// cell i, Z' = Z - w / (1 + w Z_ii) x x^T and m' = m + (db - w m_i) / (1 + w Z_ii) x.
void FieldEngine::AddReading(const CellChange& change) {
  const Slot slot = tree_->slot(change.cell);
  const double precision = change.input.precision - cells_.precision[slot];
  const double deviation = change.input.weighted_deviation - cells_.weighted_deviation[slot];
  Store(change);
  if (cells_.active[slot] == 0 || (precision == 0.0 && deviation == 0.0)) return;
  SlotColumns column = factor_.Extend(factor_.InverseOnPaths({&slot, 1}));
  constexpr double kAsItIs = 1.0;
  CorrectColumns(pending_, {&slot, 1}, {&kAsItIs, 1}, column);
  const double scale = 1.0 / (1.0 + precision * *column.row(slot));
  // The published mean may be off by the tolerance, which the update would spread.
  const double mean_ppm = Mean_ppm(factor_, pending_, slot);
  const double mean_factor = (deviation - precision * mean_ppm) * scale;
  pending_.push_back(std::make_shared<PendingReading>(
      PendingReading{slot, std::move(column), precision * scale, mean_factor}));
  marginals_.Add(*pending_.back());
}

void FieldEngine::Store(const CellChange& change) {
  const Slot slot = tree_->slot(change.cell);
  cells_.active[slot] = change.input.active ? 1 : 0;
  cells_.precision[slot] = change.input.precision;
  cells_.weighted_deviation[slot] = change.input.weighted_deviation;
}

// Flags the nodes that hold a term with the cell: its own, and those of active neighbours that are
// eliminated earlier.
void FieldEngine::MarkChange(const CellChange& change) {
  const Slot slot = tree_->slot(change.cell);
  const bool was_active = cells_.active[slot] != 0;
  if (!was_active && !change.input.active) return;
  MarkPath(slot);
  if (was_active == change.input.active) return;
  for (const Slot next : tree_->neighbours(slot)) {
    if (next < slot && cells_.active[next] != 0) MarkPath(next);
  }
}

void FieldEngine::MarkPath(Slot slot) {
  std::uint32_t node = tree_->owner(slot);
  while (node != SeparatorTree::kNone && dirty_[node] == 0) {
    dirty_[node] = 1;
    node = tree_->nodes()[node].parent;
  }
}

void FieldEngine::Recompute() {
  std::fill(dirty_.begin(), dirty_.end(), std::uint8_t{1});
  Refresh();
}

void FieldEngine::Refresh() {
  for (const auto& reading : pending_) MarkPath(reading->slot);
  marginals_.Absorb(factor_, pending_, dirty_);
  pending_.clear();
  factor_.Eliminate(dirty_, cells_, builder_);
  error_bound_ = marginals_.Descend(factor_, dirty_, options_.tolerance);
  std::fill(dirty_.begin(), dirty_.end(), std::uint8_t{0});
}

}  // namespace plumescout
