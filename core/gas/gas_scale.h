// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "core/types/options.h"

namespace plumescout {

// The field is Gaussian in y: the concentration, or its root, in which gas that comes and goes is
// as noisy where there is much as where there is little. m_0 is `gas.background_mean_ppm`. In a
// field of roots precisions are of roots (lambda in ppm^-1), and the variance that a reading brings
// says what it weighs beside one of the mission's 1 / lambda_o.

inline double OnScale(const GasOptions& gas, double concentration_ppm) {
  if (gas.scale == GasScale::kLinear) return concentration_ppm;
  return std::sqrt(std::max(0.0, concentration_ppm));
}

// y - y(m_0).
inline double DeviationOnScale(const GasOptions& gas, double concentration_ppm) {
  return OnScale(gas, concentration_ppm) - OnScale(gas, gas.background_mean_ppm);
}

struct GasEstimate {
  // Half of what is likely lies above: the median, which is also the mean of a linear field. The
  // mean of y^2 is larger by the variance of y, and far from readings, where that says little, it
  // would be gas that nobody has read.
  double median_ppm = 0.0;
  double variance_ppm2 = 0.0;
};

// What a deviation with this variance on the scale is in ppm, exactly: of a Gaussian y the variance
// of y^2 is 4 mean^2 v + 2 v^2.
inline GasEstimate OffScale(const GasOptions& gas, double deviation, double variance) {
  if (gas.scale == GasScale::kLinear) return {gas.background_mean_ppm + deviation, variance};
  const double mean = OnScale(gas, gas.background_mean_ppm) + deviation;
  const double root = std::max(0.0, mean);
  return {root * root, (4.0 * mean * mean + 2.0 * variance) * variance};
}

}  // namespace plumescout
