// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "core/gas/unread_discount.h"
#include "core/types/options.h"

namespace plumescout {

// How well readings fit the field that was made of them.
struct FieldFit {
  // The least energy of the field: z^T C^-1 z with the deviations z of all readings and what the
  // model says of their covariance, C. It is sum of lambda_k (z_k - m_0)^2 - h^T m for the field
  // H m = h. If the model is right it is as large as their number, give or take its root.
  double energy = 0.0;
  // How many readings there are, however precise each is said to be; where they age, those that are
  // less precise than the mission's count for as much less.
  double readings = 0.0;
  // How many data they are: of a reading along the way (WayReadings) each cell that it passed has
  // one.
  double data = 0.0;
  // `energy` with the part of each cell over LevelScale of its deviation.
  double level_energy = 0.0;
};

// By what factor variances are larger than the model says: that all its precisions are wrong alike
// is what a fit can tell. Then given s, z ~ N(0, s C), and with an inverse gamma prior of mean 1
// and infinite variance (a = 2, b = 1) the mean of s given z is (2 + energy) / (2 + readings).
// Not below 1: from readings that are all alike it does not follow that sensors have no noise.
inline double NoiseScale(const FieldFit& fit) {
  return std::max(1.0, (2.0 + std::max(0.0, fit.energy)) / (2.0 + fit.readings));
}

// Errors are larger where there is more gas, by what one scale for the whole field cannot say: gas
// comes and goes where there is some. So the variance of a cell with the field's deviation d grows
// by this, found in missions that were simulated (docs/decisions/0032-noise-by-level.md), with what
// UnreadDiscount leaves (0035-what-robots-pass-by.md) and without; the root of lambda_p takes the
// unit away. With gusts this is what Relevance goes by, and of what is published clean air alone.
inline double LevelScale(const GasOptions& gas, double deviation_ppm) {
  constexpr double kCleanAir = 0.5;
  const double per_level = UnreadDiscount::Holds(gas) ? 10.0 : 13.0;
  return per_level *
         (kCleanAir + std::sqrt(gas.prior_precision_per_ppm2) * std::abs(deviation_ppm));
}

// Whether variances are scaled by it, cell by cell.
inline bool HasNoiseByLevel(const GasOptions& gas) {
  return gas.noise_by_level && gas.estimate_noise && gas.scale == GasScale::kLinear &&
         gas.precisions == GasPrecisions::kFixed;
}

struct NoiseEstimate {
  double scale = 1.0;
  double log_stddev = 0.0;  // of its logarithm, nearly; 0: not estimated
  // By what factor variances are larger than LevelScale says: NoiseScale with `level_energy`.
  double level_scale = 1.0;

  // How far the truth of a cell may be, as a variance, from what is told of it: `told_ppm` above
  // the background is what UnreadDiscount leaves of the field's deviation, whose own variance is
  // `variance_ppm2`. With gusts (docs/decisions/0036-errors-where-there-is-most.md) that of the
  // field is scaled as in clean air, gusts add their share of what there is, read or not, and
  // what was discounted may be wrong by twice itself.
  double VarianceOf_ppm2(const GasOptions& gas, double variance_ppm2, double told_ppm,
                         double field_ppm) const {
    if (!HasNoiseByLevel(gas)) return scale * variance_ppm2;
    if (gas.gust_ratio == 0.0) return level_scale * LevelScale(gas, told_ppm) * variance_ppm2;
    constexpr double kDiscountError = 2.0;
    const double gust_ppm = gas.gust_ratio * told_ppm;
    const double discount_ppm = kDiscountError * (field_ppm - told_ppm);
    return level_scale * (LevelScale(gas, 0.0) * variance_ppm2 + gust_ppm * gust_ppm) +
           discount_ppm * discount_ppm;
  }
};

}  // namespace plumescout
