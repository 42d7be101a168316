// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/field_engine.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/gas/field/field_solve.h"

namespace plumescout {
namespace {

// Share of the tolerance that a pass may use; readings until the next one may use the rest.
constexpr double kPassShare = 0.5;
// Each of those may use this share of what the earlier ones have left. Passes are frequent, so that
// mostly the first few readings count; with a lower tolerance a later one only costs more.
constexpr double kReadingShare = 0.25;

std::shared_ptr<const SeparatorTree> MakeTree(std::size_t width, std::size_t height,
                                              std::span<const CellInput> cells,
                                              const StopFn& stop) {
  std::vector<std::uint8_t> active;
  active.reserve(cells.size());
  for (const CellInput& cell : cells) active.push_back(cell.active ? 1 : 0);
  return std::make_shared<SeparatorTree>(width, height, active, stop);
}

absl::Status Check(const CellChange& change, std::size_t cells) {
  if (change.cell >= cells) return absl::InvalidArgumentError("a cell lies beyond the lattice");
  if (IsPossible(change.input)) return absl::OkStatus();
  return absl::InvalidArgumentError("the evidence of a cell is out of range");
}

absl::Status Abandoned() { return absl::CancelledError("the gas field is abandoned"); }

bool HasSameLinks(const CellInput& a, const CellInput& b) {
  return a.linked_east == b.linked_east && a.linked_north == b.linked_north;
}

}  // namespace

FieldEngine::FieldEngine(std::size_t width, std::size_t height, std::vector<CellInput> cells,
                         const FieldOptions& options)
    : options_(options),
      tree_(MakeTree(width, height, cells, options.stop)),
      cells_(*tree_, cells),
      builder_(*tree_, options.prior),
      factor_(tree_),
      marginals_(*tree_),
      dirty_(tree_->nodes().size()) {
  cells = {};  // makes room
  Recompute();
}

absl::Status FieldEngine::Apply(std::span<const CellChange> changes) {
  if (abandoned_) return Abandoned();
  for (const CellChange& change : changes) {
    const absl::Status status = Check(change, tree_->cells());
    if (!status.ok()) return status;
  }
  if (pending_ + changes.size() <= options_.max_pending && AreReadings(changes)) {
    for (const CellChange& change : changes) AddReading(change);
    return Heal();
  }
  for (const CellChange& change : changes) {
    MarkChange(change);
    cells_.Set(*tree_, change);
  }
  Refresh();
  return Heal();
}

// Whether each change only adds to what is known of its cell, or concerns a cell without variable.
bool FieldEngine::AreReadings(std::span<const CellChange> changes) const {
  return std::all_of(changes.begin(), changes.end(), [this](const CellChange& change) {
    const CellInput was = input(change.cell);
    const CellInput& is = change.input;
    if (!was.active && !is.active) return true;
    return was.active == is.active && HasSameLinks(was, is) && is.precision >= was.precision;
  });
}

void FieldEngine::AddReading(const CellChange& change) {
  const CellInput was = input(change.cell);
  cells_.Set(*tree_, change);
  const FieldReading reading = {tree_->slot(change.cell), change.input.precision - was.precision,
                                change.input.weighted_deviation - was.weighted_deviation};
  const bool is_new = reading.precision != 0.0 || reading.weighted_deviation != 0.0;
  if (!was.active || !is_new) return;
  ++pending_;
  reading_share_left_ *= 1.0 - kReadingShare;
  const FieldShift limit = ((1.0 - kPassShare) * (1.0 - reading_share_left_)) * Tolerance();
  const std::vector<PathStep> steps = factor_.StepsFrom(reading.slot);
  healthy_ = marginals_.Hear(factor_, reading, steps, limit) && healthy_;
  factor_.AddReading(steps, reading.precision, reading.weighted_deviation);
  MarkPath(reading.slot);
}

// Flags the nodes that hold a term with the cell: its own, and those of active neighbours that are
// eliminated earlier.
void FieldEngine::MarkChange(const CellChange& change) {
  const Slot slot = tree_->slot(change.cell);
  const CellInput was = cells_.Get(slot);
  const CellInput& is = change.input;
  if (!was.active && !is.active) return;
  MarkPath(slot);
  if (was.active == is.active && HasSameLinks(was, is)) return;
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
  healthy_ = true;
  std::fill(dirty_.begin(), dirty_.end(), std::uint8_t{1});
  Refresh();
}

void FieldEngine::Refresh() {
  pending_ = 0;
  reading_share_left_ = 1.0;
  abandoned_ = abandoned_ || !factor_.Eliminate(dirty_, cells_, builder_, options_.stop);
  if (abandoned_) return;
  const Marginals::Pass pass =
      marginals_.Descend(factor_, dirty_, kPassShare * Tolerance(), options_.stop);
  abandoned_ = pass.stopped;
  shift_ = pass.error;
  healthy_ = healthy_ && pass.healthy;
  largest_mean_ppm_ = marginals_.LargestMean_ppm();
  std::fill(dirty_.begin(), dirty_.end(), std::uint8_t{0});
}

absl::Status FieldEngine::Heal() {
  if (abandoned_) return Abandoned();
  if (healthy_) return absl::OkStatus();
  assert(false && "a field is not finite, or a variance not positive");
  ++healed_;
  Recompute();
  if (abandoned_) return Abandoned();
  return healthy_ ? absl::OkStatus() : absl::InternalError("the gas field cannot be computed");
}

FieldShift FieldEngine::Tolerance() const {
  return {options_.tolerance.mean_share * largest_mean_ppm_,
          options_.tolerance.variance_share / VarianceRatioOfShift()};
}

FieldDeviation FieldEngine::error_bound() const {
  const FieldShift shift = shift_ + marginals_.owed();
  return {shift.mean_ppm, shift.covariance_ppm2 * VarianceRatioOfShift()};
}

// If no covariance on the boundary of a subtree has moved by more than d, no variance inside has
// moved by more than this, times d, of itself. For the weights w_a of the boundary on cell a are
// lambda_p / H_aa times the sum of those on its neighbours, which sum to 1 at most: so the sum s of
// w_a is at most n lambda_p / H_aa for n <= 4 neighbours, the variance moves by w_a^T D w_a <= d
// s^2, and it is 1 / H_aa at least. Together d (n lambda_p)^2 / H_aa <= d n lambda_p.
double FieldEngine::VarianceRatioOfShift() const {
  constexpr double kNeighbours = 4.0;
  return kNeighbours * options_.prior.prior_precision_per_ppm2;
}

std::vector<double> FieldEngine::Solve(std::span<const double> right_side) const {
  std::vector<double> by_slot(tree_->cells());
  for (std::size_t cell = 0; cell < by_slot.size(); ++cell) {
    by_slot[tree_->slot(cell)] = right_side[cell];
  }
  by_slot = SolveField(factor_, by_slot);
  std::vector<double> by_cell(by_slot.size());
  for (std::size_t cell = 0; cell < by_cell.size(); ++cell) {
    by_cell[cell] = by_slot[tree_->slot(cell)];
  }
  return by_cell;
}

}  // namespace plumescout
