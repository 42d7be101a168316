// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/field/entropy_fall.h"
#include "core/gas/field/field_factor.h"
#include "core/gas/field/inverse_columns.h"
#include "core/types/stop.h"

namespace plumescout {

// A reading that may be taken in a cell of the lattice.
struct ForeseenReading {
  std::size_t cell = 0;
  double precision = 0.0;  // ppm^-2
};

// The field at one moment, for planning. Shares all its nodes with the engine that made it, which
// goes on without changing them. Immutable, so it may be read from any thread.
class FieldSnapshot {
 public:
  // `variance_ppm2` by slot. A fall of a variance inside a subtree may be left out if on the
  // boundary of that none falls by more than `tolerance_ppm2`; 0: none is.
  FieldSnapshot(FieldFactor factor, std::vector<double> variance_ppm2, double tolerance_ppm2)
      : factor_(std::move(factor)),
        variance_ppm2_(std::move(variance_ppm2)),
        tolerance_ppm2_(tolerance_ppm2) {}

  // Marginal variance of every cell, by cell index, if readings of `precision` each were taken in
  // `cells`; NaN off the active cells. A reading in a cell that is not active changes nothing.
  // Beside the error that variances have now, no variance is too great by more than the engine's
  // tolerance on variances as share of itself, and none too small.
  // Errors: kInvalidArgument for a cell beyond the lattice, or a precision that is not positive or
  // beyond kMaxCellPrecision. Cost: O(k) passes over the factor for k cells, less
  // what they hardly tell of.
  absl::StatusOr<std::vector<double>> VarianceIfRead(std::span<const std::size_t> cells,
                                                     double precision) const;

  // Columns of which |x|^2 is by how much that would lower the variance of each cell; none if no
  // cell is active. They refer to this snapshot. Errors: those of VarianceIfRead. Cost: that of the
  // paths of the cells. They take the memory of columns that are `used` no more.
  // kCancelled once `stop`, which is asked all along, says so.
  absl::StatusOr<std::optional<InverseColumns>> ColumnsIfRead(
      std::span<const std::size_t> cells, double precision, const StopFn& stop = {},
      std::optional<InverseColumns> used = std::nullopt) const;
  // For such columns. `weights` >= 0 by slot, and what each variance has beside that of the field,
  // by cell index, if anything. Refers to this snapshot. Of no use once `stop`, which is asked all
  // along, says so.
  EntropyFall FallOf(std::vector<double> weights, std::span<const double> beside_ppm2,
                     const StopFn& stop = {}) const;

  // The snapshot of a field that has heard these readings besides; what they say is not known, so
  // it has variances only. Errors and cost: those of VarianceIfRead, and a copy of the fronts on
  // the paths of the cells. Tolerances add up.
  // kCancelled once `stop`, which is asked all along, says so.
  absl::StatusOr<FieldSnapshot> Given(std::span<const ForeseenReading> readings,
                                      const StopFn& stop = {}) const;

  // Marginal variance by cell index; NaN off the active cells. Of no use once `stop`, which is
  // asked all along, says so. Cost: O(cells).
  std::vector<double> variance_ppm2(const StopFn& stop = {}) const;
  double variance_ppm2(std::size_t cell) const { return variance_ppm2_[slot(cell)]; }
  Slot slot(std::size_t cell) const { return factor_.tree().slot(cell); }

 private:
  // Readings of active cells, by slot.
  struct Foreseen {
    std::vector<Slot> slots;
    std::vector<double> noise_ppm2;  // 1 / precision of each
  };

  bool IsActive(Slot slot) const { return variance_ppm2_[slot] > 0.0; }  // not NaN
  absl::StatusOr<Foreseen> ActiveOf(std::span<const ForeseenReading> readings) const;
  absl::StatusOr<InverseColumns> GainColumns(
      const Foreseen& readings, const StopFn& stop,
      std::optional<InverseColumns> used = std::nullopt) const;
  std::vector<double> ByCell(const std::vector<double>& by_slot, const StopFn& stop) const;

  FieldFactor factor_;
  std::vector<double> variance_ppm2_;  // by slot
  double tolerance_ppm2_;
};

}  // namespace plumescout
