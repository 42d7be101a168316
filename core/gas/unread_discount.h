// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "core/types/options.h"

namespace plumescout {

// Robots that seek gas read where there is most of it, and what they pass by is less than a field
// says that is as smooth beside their ways as along them (sampling that is preferential). So what a
// map tells of a cell is the field's deviation from the background over
//   1 + (unread_discount_ratio * v / epsilon_inf)^2,
// with the cell's variance v and OpenLatticeVariance_ppm2, epsilon_inf, of what nobody has read.
// Numbers were found in simulated missions (docs/decisions/0035-what-robots-pass-by.md), with
// fields that are linear; of others the field is told as it is.
class UnreadDiscount {
 public:
  // REQUIRES: Validate(gas).ok().
  explicit UnreadDiscount(const GasOptions& gas)
      : per_ppm2_(Holds(gas) ? gas.unread_discount_ratio / Unit_ppm2(gas) : 0.0) {}

  static bool Holds(const GasOptions& gas) {
    return gas.unread_discount_ratio > 0.0 && gas.scale == GasScale::kLinear;
  }

  // What is told of a deviation. The variance is in the unit in which the prior has the precisions
  // of the options: times PriorScale::theta where they are learned.
  double Of(double deviation_ppm, double variance_ppm2) const {
    const double unread = per_ppm2_ * variance_ppm2;
    return deviation_ppm / (1.0 + unread * unread);
  }

  // How far that may be off where the deviation errs by so much and the variance by a small share
  // of itself.
  double ErrorOf_ppm(double told_ppm, double error_ppm, double variance_error_ratio) const {
    if (per_ppm2_ == 0.0) return error_ppm;
    return error_ppm + 2.0 * variance_error_ratio * std::abs(told_ppm);
  }

 private:
  // epsilon_inf; that is a variance of the lattice only if lambda_d is well below 32 lambda_p, and
  // none is below 1 / (8 lambda_p + lambda_d).
  static double Unit_ppm2(const GasOptions& gas) {
    constexpr double kMostLinks = 8.0;
    return std::max(
        OpenLatticeVariance_ppm2(gas),
        1.0 / (kMostLinks * gas.prior_precision_per_ppm2 + gas.background_precision_per_ppm2));
  }

  double per_ppm2_;
};

}  // namespace plumescout
