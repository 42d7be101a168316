// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "core/gas/field/field_shift.h"

namespace plumescout {

// Joint distribution of the boundary of a node.
struct BoundaryField {
  std::span<const double> mean_ppm;
  std::span<const double> covariance_ppm2;  // both triangles
};

// How a reading changes a field: with x the covariance of a cell with the cell that is read, its
// mean m becomes m + mean_factor x, the covariance Z of two cells Z - variance_factor x x'
// (Sherman and Morrison).
struct ReadingFactors {
  double mean_factor = 0.0;
  double variance_factor = 0.0;
};

// The boundary that the fields of a node were last computed from.
class BoundaryMemory {
 public:
  void Remember(const BoundaryField& boundary);
  // By how much the present boundary differs. Settles what has been heard.
  FieldShift Moved(const BoundaryField& boundary);
  // The fields of the node have heard a reading, so that all is as if they had been computed from a
  // boundary that had heard it too. `x` is by boundary cell. Cost: O(x), the square of it at times.
  void Hear(const ReadingFactors& factors, std::span<const double> x);
  // Ask memory for what the others will read.
  void PrefetchForMoved() const;
  void PrefetchForHear() const;

 private:
  void Settle();

  std::vector<double> mean_ppm_;
  std::vector<double> covariance_ppm2_;  // lower triangle, packed by columns
  // Readings that the covariances have yet to hear: one pass over them serves several.
  std::vector<double> heard_;  // variance factor and x, reading by reading
};

}  // namespace plumescout
