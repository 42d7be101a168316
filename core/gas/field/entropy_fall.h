// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/gas/field/field_factor.h"
#include "core/gas/field/inverse_columns.h"
#include "core/types/stop.h"

namespace plumescout {

// A field at one moment, to ask by how much sets of readings would lower its entropy:
//
//   sum over active cells of weight * 1/2 ln(variance / (variance - |x|^2))
//
// with x the row of a cell in the columns that FieldSnapshot::ColumnsIfRead makes of the readings.
//
// What a subtree off their paths has of that is bounded from the squares on its boundary alone.
// With x_S = W x_R, W >= 0 with row sums r <= 1, Jensen has |x_s|^2 <= r_s sum W_sj |x_j|^2; and
// the logarithm lies below its chord. Both are linear in |x_j|^2, so that the weights of the
// boundary in the bound are the same for all readings: one pass up the tree finds them.
class EntropyFall {
 public:
  // `variance_ppm2` and `weights` >= 0 by slot; those of other than active cells do not matter.
  // Falls of the variance are left out as FieldSnapshot does. REQUIRES: `factor` outlives this.
  EntropyFall(const FieldFactor& factor, std::vector<double> variance_ppm2,
              std::vector<double> weights, double tolerance_ppm2);
  // The same with variances that outlive this.
  EntropyFall(const FieldFactor& factor, std::span<const double> variance_ppm2,
              std::vector<double> weights, double tolerance_ppm2);
  EntropyFall(EntropyFall&&) = default;
  EntropyFall& operator=(EntropyFall&&) = default;

  // Nats. None if `stop`, which is asked all along, said so. Cost: that of the columns in every
  // active cell, less what readings hardly tell of.
  std::optional<double> Of(InverseColumns& columns, const StopFn& stop) const;
  // What AtMost needs. `stop` is asked all along. Cost: about that of SolveField.
  void FindBounds(const StopFn& stop = {});
  // No less than Of; none without bounds. Cost: that of the columns near their own cells.
  std::optional<double> AtMost(InverseColumns& columns, const StopFn& stop) const;

 private:
  class Sum;

  // What falls inside a node and below it are at most, by those on its boundary.
  struct Bound {
    std::size_t first = 0;      // in boundary_weights_, one for each cell of the boundary
    double greatest_share = 0;  // of its variance that a cell loses if the boundary loses 1 ppm^2
  };
  void FindBound(std::size_t node);

  const FieldFactor* factor_;
  std::vector<double> own_variance_ppm2_;  // moves without its elements moving
  std::span<const double> variance_ppm2_;
  std::vector<double> weights_;
  double tolerance_ppm2_;
  bool has_bounds_ = false;
  std::vector<Bound> bounds_;  // by node
  std::vector<double> boundary_weights_;

  // Of FindBound.
  std::vector<double> slopes_;  // of the cells of the present front
  std::vector<double> scratch_;
};

}  // namespace plumescout
