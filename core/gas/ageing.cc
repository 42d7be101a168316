// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/ageing.h"

#include <algorithm>

namespace plumescout {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;
constexpr double kLeastVariance_ppm2 = 1e-9;  // lambda_o <= 1e9, see Validate(GasOptions)
constexpr double kMostVariance_ppm2 = 1e30;   // says nothing beside lambda_d >= 1e-9, see there

}  // namespace

Ageing::Ageing(const GasOptions& options)
    : default_variance_ppm2_(1.0 / options.observation_precision_per_ppm2),
      variance_growth_ppm2_per_s_(options.ageing_half_life_s > 0.0
                                      ? default_variance_ppm2_ / options.ageing_half_life_s
                                      : 0.0),
      relative_stddev_(options.observation_stddev_share),
      background_mean_ppm_(options.background_mean_ppm) {}

double Ageing::InitialVariance_ppm2(const GasReading& reading) const {
  if (reading.variance_ppm2 > 0.0) {
    return std::clamp(reading.variance_ppm2, kLeastVariance_ppm2, kMostVariance_ppm2);
  }
  if (relative_stddev_ == 0.0) return default_variance_ppm2_;
  const double stddev_ppm = relative_stddev_ * (reading.concentration_ppm - background_mean_ppm_);
  return std::min(std::max(default_variance_ppm2_, stddev_ppm * stddev_ppm), kMostVariance_ppm2);
}

double Ageing::Variance_ppm2(double initial_variance_ppm2, std::int64_t taken_ns,
                             std::int64_t now_ns) const {
  // In double: the difference of any two clocks, without overflow.
  const double age_s = std::max(
      0.0, (static_cast<double>(now_ns) - static_cast<double>(taken_ns)) * kSecondsPerNanosecond);
  return initial_variance_ppm2 + age_s * variance_growth_ppm2_per_s_;
}

}  // namespace plumescout
