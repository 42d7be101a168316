// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/field/cell_input.h"
#include "core/gas/field/field_factor.h"
#include "core/gas/field/field_snapshot.h"
#include "core/gas/field/front.h"
#include "core/gas/field/marginals.h"
#include "core/gas/field/separator_tree.h"
#include "core/types/stop.h"

namespace plumescout {

// How far the fields may be from the exact ones; 0: only what is the same to the last bit is left
// alone.
struct FieldTolerance {
  double mean_share = 1e-5;      // of the largest absolute deviation of all means
  double variance_share = 1e-5;  // of each variance
};

// How far they are at most, in any cell and beside rounding.
struct FieldDeviation {
  double mean_ppm = 0.0;
  double variance_ratio = 0.0;  // of the exact variance
};

struct FieldOptions {
  FieldPrior prior;
  FieldTolerance tolerance;
  // Readings that may pass over cells they hardly touch, before a pass for changes sees to those.
  std::size_t max_pending = 16;
  // Asked at every node, on whatever thread computes. Once it says so the engine is abandoned.
  StopFn stop = {};
};

// The posterior of [IPP] Eq. (1)-(6) on a lattice, kept exact while readings arrive and cells
// become active or not.
//
//   FieldEngine field(width, height, cells, options);
//   RETURN_IF_ERROR(field.Apply(changes));
//   field.mean_ppm(cell), field.variance_ppm2(cell)
//
// The same calls give the same bytes. Thread-compatible; snapshots may be read meanwhile.
class FieldEngine {
 public:
  // `cells` by index y * width + x: width * height of them. Their activity shapes the tree; all
  // others may become active later, at some loss if most do. REQUIRES: width, height >= 1, inputs
  // as Apply takes them, precisions of the prior > 0.
  FieldEngine(std::size_t width, std::size_t height, std::vector<CellInput> cells,
              const FieldOptions& options);

  // Brings the fields up to date with all changes; of several to one cell the last holds. Added
  // readings cost a column of the inverse each, as far as it matters; anything else, and every
  // `max_pending`-th reading, the paths of the changed cells upward and a pruned pass downward.
  // Errors: kInvalidArgument, with nothing changed, for a cell beyond the lattice, a precision that
  // is negative, NaN or beyond kMaxCellPrecision, a deviation that is not finite or beyond it.
  // kInternal if a field is not finite or a variance not positive even after a fresh computation;
  // the next call tries again. kCancelled if the engine is abandoned.
  absl::Status Apply(std::span<const CellChange> changes);

  // Everything from scratch; afterwards the fields are exact to rounding.
  void Recompute();

  // FieldOptions::stop ended a computation: fields and factor are of no use, only their size is.
  bool abandoned() const { return abandoned_; }

  // Deviation from m_0 and marginal variance; NaN off the active cells.
  double mean_ppm(std::size_t cell) const { return marginals_.mean_ppm()[tree_->slot(cell)]; }
  double variance_ppm2(std::size_t cell) const {
    return marginals_.variance_ppm2()[tree_->slot(cell)];
  }
  // Of all cells, in an order that the same calls give again.
  const std::vector<double>& means_ppm() const { return marginals_.mean_ppm(); }
  const std::vector<double>& variances_ppm2() const { return marginals_.variance_ppm2(); }
  // Within the tolerance, that of the mean being a share of its largest value before the batch.
  FieldDeviation error_bound() const;

  std::size_t width() const { return tree_->width(); }
  std::size_t cells() const { return tree_->cells(); }
  // What was last told of a cell.
  CellInput input(std::size_t cell) const { return cells_.Get(tree_->slot(cell)); }
  const FieldCells& heard() const { return cells_; }  // of all of them
  // Fresh computations that became necessary because a field was not finite, or a variance not
  // positive. Each is a defect; builds with assertions stop there.
  std::int64_t healed() const { return healed_; }
  // Multiply-adds that eliminating all cells takes with this tree: by it a new one can be judged.
  // Cost: O(nodes).
  double work() const { return factor_.work(); }

  // H^-1 g, exactly, for a right-hand side g by cell; both 0 off the active cells. Cost: as of
  // SolveField.
  std::vector<double> Solve(std::span<const double> right_side) const;

  // Cost: one pointer per node and one number per cell.
  FieldSnapshot Snapshot() const {
    return {factor_, marginals_.variance_ppm2(), Tolerance().covariance_ppm2};
  }

 private:
  friend struct FieldEnginePeer;  // of the tests

  bool AreReadings(std::span<const CellChange> changes) const;
  void AddReading(const CellChange& change);
  void MarkChange(const CellChange& change);
  void MarkPath(Slot slot);
  void Refresh();
  absl::Status Heal();
  FieldShift Tolerance() const;
  double VarianceRatioOfShift() const;

  FieldOptions options_;
  std::shared_ptr<const SeparatorTree> tree_;
  FieldCells cells_;
  FrontBuilder builder_;
  FieldFactor factor_;
  Marginals marginals_;
  std::vector<std::uint8_t> dirty_;  // by node
  std::size_t pending_ = 0;          // readings since the last pass
  double reading_share_left_ = 1.0;  // of the tolerance for readings until the next one
  FieldShift shift_;                 // how far the fields were off after it, at most
  double largest_mean_ppm_ = 0.0;    // then
  bool healthy_ = true;
  bool abandoned_ = false;
  std::int64_t healed_ = 0;
};

}  // namespace plumescout
