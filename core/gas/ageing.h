// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/types/options.h"

namespace plumescout {

// Precision of a reading as it grows old: lambda(t) = 1 / (1 / lambda_o + (t - t_k) / lambda_t).
class Ageing {
 public:
  // lambda_t = half-life * lambda_o of the mission, so readings of any variance lose the same
  // 1 / lambda_o per half-life. Without a half-life nothing ages.
  explicit Ageing(const GasOptions& options);

  bool enabled() const { return variance_growth_ppm2_per_s_ > 0.0; }

  // 1 / lambda_o for this reading: its own variance if it brings one, else the mission's. Not below
  // the least variance a mission can be configured with, so that H stays finite.
  double InitialVariance_ppm2(double own_variance_ppm2) const;

  // lambda(now) of a reading taken at `taken_ns`, ppm^-2. A reading from the future (clocks of
  // robots differ) has age 0.
  double Precision(double initial_variance_ppm2, std::int64_t taken_ns, std::int64_t now_ns) const;

 private:
  double default_variance_ppm2_;       // 1 / lambda_o
  double variance_growth_ppm2_per_s_;  // 1 / lambda_t
};

}  // namespace plumescout
