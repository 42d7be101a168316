// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace plumescout {

// How far means and covariances have moved, may be off, or are allowed to be: each of them at most.
struct FieldShift {
  double mean_ppm = 0.0;
  double covariance_ppm2 = 0.0;

  bool IsWithin(const FieldShift& limit) const {
    return mean_ppm <= limit.mean_ppm && covariance_ppm2 <= limit.covariance_ppm2;
  }
};

inline FieldShift operator+(const FieldShift& a, const FieldShift& b) {
  return {a.mean_ppm + b.mean_ppm, a.covariance_ppm2 + b.covariance_ppm2};
}

inline FieldShift operator*(double factor, const FieldShift& a) {
  return {factor * a.mean_ppm, factor * a.covariance_ppm2};
}

inline FieldShift Max(const FieldShift& a, const FieldShift& b) {
  return {std::max(a.mean_ppm, b.mean_ppm), std::max(a.covariance_ppm2, b.covariance_ppm2)};
}

}  // namespace plumescout
