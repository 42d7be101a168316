// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace plumescout {

// Probability that a standard normal variable is below `z`.
inline double NormalProbability(double z) {
  constexpr double kSqrtHalf = 0.70710678118654752440;
  return 0.5 * std::erfc(-z * kSqrtHalf);
}

// The z below which it is with this probability. REQUIRES: `probability` in [1e-9, 1 - 1e-9].
inline double NormalQuantile(double probability) {
  double low = -6.5;
  double high = 6.5;
  constexpr int kHalvings = 60;  // until nothing is left between them
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (NormalProbability(middle) < probability ? low : high) = middle;
  }
  return high;
}

}  // namespace plumescout
