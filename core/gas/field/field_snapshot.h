// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/field/field_factor.h"

namespace plumescout {

// The field at one moment, for planning. Shares all its nodes with the engine that made it, which
// goes on without changing them. Immutable, so it may be read from any thread.
class FieldSnapshot {
 public:
  FieldSnapshot(FieldFactor factor, std::vector<double> variance_ppm2)
      : factor_(std::move(factor)), variance_ppm2_(std::move(variance_ppm2)) {}

  // Marginal variance of every cell, by cell index, if readings of `precision` each were taken in
  // `cells`; NaN off the active cells. A reading in a cell that is not active changes nothing.
  // Errors: kInvalidArgument for a cell beyond the lattice, or a precision that is not positive or
  // beyond kMaxCellPrecision. Cost: O(k) passes over the factor for k cells.
  absl::StatusOr<std::vector<double>> VarianceIfRead(std::span<const std::size_t> cells,
                                                     double precision) const;

 private:
  FieldFactor factor_;
  std::vector<double> variance_ppm2_;  // by slot
};

}  // namespace plumescout
