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
#include "core/gas/field/pending_reading.h"
#include "core/gas/field/separator_tree.h"

namespace plumescout {

struct FieldOptions {
  FieldPrior prior;
  // How far the fields may stay behind the exact ones after a batch that is not readings alone; 0:
  // only subtrees whose surroundings are the same to the last bit are left alone.
  FieldError tolerance;
  // Readings that the factor may lag behind; each makes the next one dearer by one pass over the
  // cells, and saves a path of fronts.
  std::size_t max_pending = 16;
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
  FieldEngine(std::size_t width, std::size_t height, std::span<const CellInput> cells,
              const FieldOptions& options);

  // Brings the fields up to date with all changes; of several to one cell the last holds. Up to
  // `max_pending` batches of added readings cost a column of the inverse each; anything else the
  // paths of the changed cells upward and a pruned pass downward.
  // Errors, after which nothing has changed: kInvalidArgument for a cell beyond the lattice, a
  // precision that is negative, NaN or beyond kMaxCellPrecision, a deviation that is not finite or
  // beyond it.
  absl::Status Apply(std::span<const CellChange> changes);

  // Everything from scratch; afterwards the fields are exact to rounding.
  void Recompute();

  // Deviation from m_0 and marginal variance; NaN off the active cells.
  double mean_ppm(std::size_t cell) const { return marginals_.mean_ppm()[tree_->slot(cell)]; }
  double variance_ppm2(std::size_t cell) const {
    return marginals_.variance_ppm2()[tree_->slot(cell)];
  }
  // By how much any cell may be off, beside rounding: at most the tolerance.
  const FieldError& error_bound() const { return error_bound_; }

  // Cost: one pointer per node and one number per cell.
  FieldSnapshot Snapshot() const { return {factor_, pending_, marginals_.variance_ppm2()}; }

 private:
  bool AreReadings(std::span<const CellChange> changes) const;
  void AddReading(const CellChange& change);
  void Store(const CellChange& change);
  void MarkChange(const CellChange& change);
  void MarkPath(Slot slot);
  void Refresh();

  FieldOptions options_;
  std::shared_ptr<const SeparatorTree> tree_;
  FieldCells cells_;
  FrontBuilder builder_;
  FieldFactor factor_;
  Marginals marginals_;
  PendingReadings pending_;
  std::vector<std::uint8_t> dirty_;  // by node
  FieldError error_bound_;
};

}  // namespace plumescout
