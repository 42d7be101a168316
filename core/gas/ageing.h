// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/gas_reading.h"
#include "core/types/options.h"

namespace plumescout {

// Precision of a reading as it grows old: lambda(t) = 1 / (1 / lambda_o + (t - t_k) / lambda_t).
class Ageing {
 public:
  // lambda_t = half-life * lambda_o of the mission, so readings of any variance lose the same
  // 1 / lambda_o per half-life. Without a half-life nothing ages.
  explicit Ageing(const GasOptions& options);

  bool enabled() const { return variance_growth_ppm2_per_s_ > 0.0; }

  // 1 / lambda_o for this reading: its own variance if it brings one, else the mission's,
  // max(1 / lambda_o, (kappa |z - m_0|)^2). Kept within [1e-9, 1e30] ppm^2, so that H and products
  // of two variances stay finite.
  //
  // [LHR] II-A has the variance proportional to the magnitude of the reading. Ours differs: by the
  // floor, since a reading of 0 is no perfect one; by the square, since gusts scale a plume, so
  // that its standard deviation goes with its mean; and by counting from the background (the
  // paper's is 0), since clean air of 400 ppm of CO2 is steady, however large its reading.
  double InitialVariance_ppm2(const GasReading& reading) const;

  // 1 / lambda(now) of a reading taken at `taken_ns`. A reading from the future (clocks of robots
  // differ) has age 0.
  double Variance_ppm2(double initial_variance_ppm2, std::int64_t taken_ns,
                       std::int64_t now_ns) const;

  // lambda(now), ppm^-2.
  double Precision(double initial_variance_ppm2, std::int64_t taken_ns, std::int64_t now_ns) const {
    return 1.0 / Variance_ppm2(initial_variance_ppm2, taken_ns, now_ns);
  }

  // By what share of itself a variance grows per second; 0 without ageing.
  double GrowthShare_per_s(double variance_ppm2) const {
    return variance_growth_ppm2_per_s_ / variance_ppm2;
  }

  // Whether a reading of the mission's variance has lost half its precision; never without ageing.
  bool IsHalved(std::int64_t taken_ns, std::int64_t now_ns) const {
    return Variance_ppm2(default_variance_ppm2_, taken_ns, now_ns) >= 2.0 * default_variance_ppm2_;
  }

 private:
  double default_variance_ppm2_;       // 1 / lambda_o
  double variance_growth_ppm2_per_s_;  // 1 / lambda_t
  double relative_stddev_;             // kappa
  double background_mean_ppm_;         // m_0
};

}  // namespace plumescout
