// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/ageing_depth.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace plumescout::lab {
namespace {

constexpr int kTerms = 4;                 // besides the one that never ends
constexpr int kAges = 200;                // at which the sum is fitted, on a logarithmic scale
constexpr double kOldest = 8.0;           // of them, in times that gas takes to the mixing depth
constexpr double kYoungest = 1.0 / 30.0;  // in times that a fresh filament takes to double
constexpr double kFastestRate = 0.5;      // per the latter time
constexpr double kSlowestRate = 1.0;      // per the former

double VerticalGrowth_m2_per_s(const GasParameters& gas) {
  return gas.growth_m2_per_s + 2.0 * gas.diffusivity_m2_per_s;
}

// `count` values from `first` to `last` by equal factors.
double OnLogScale(double first, double last, int index, int count) {
  return first * std::pow(last / first, static_cast<double>(index) / (count - 1));
}

}  // namespace

double FilamentVariance_m2(const GasParameters& gas, double age_s) {
  return gas.initial_sigma_m * gas.initial_sigma_m + gas.growth_m2_per_s * age_s;
}

double DepthAtAge_m(const GasParameters& gas, double age_s) {
  const double vertical_m2 =
      FilamentVariance_m2(gas, age_s) + 2.0 * gas.diffusivity_m2_per_s * age_s;
  return std::min(gas.mixing_depth_m, std::sqrt(2.0 * M_PI * vertical_m2));
}

std::vector<DecayTerm> InverseDepthTerms(const GasParameters& gas) {
  const double fresh_m = DepthAtAge_m(gas, 0.0);
  const double growth_m2_per_s = VerticalGrowth_m2_per_s(gas);
  if (growth_m2_per_s == 0.0 || fresh_m >= gas.mixing_depth_m) return {{0.0, 1.0 / fresh_m}};
  const double doubled_s = gas.initial_sigma_m * gas.initial_sigma_m / growth_m2_per_s;
  const double mixed_s = gas.mixing_depth_m * gas.mixing_depth_m / (2.0 * M_PI * growth_m2_per_s);
  std::vector<DecayTerm> terms = {{0.0, 1.0 / gas.mixing_depth_m}};
  for (int k = 0; k < kTerms; ++k) {
    terms.push_back({OnLogScale(kSlowestRate / mixed_s, kFastestRate / doubled_s, k, kTerms), 0.0});
  }
  // Least squares of the relative error.
  Eigen::MatrixXd decay(kAges, kTerms);
  Eigen::VectorXd missing(kAges);
  for (int i = 0; i < kAges; ++i) {
    const double age_s =
        i == 0 ? 0.0 : OnLogScale(kYoungest * doubled_s, kOldest * mixed_s, i, kAges);
    const double depth_m = DepthAtAge_m(gas, age_s);
    missing[i] = 1.0 - depth_m / gas.mixing_depth_m;
    for (int k = 0; k < kTerms; ++k) {
      decay(i, k) = depth_m * std::exp(-terms[static_cast<std::size_t>(k + 1)].rate_per_s * age_s);
    }
  }
  const Eigen::VectorXd weights = decay.colPivHouseholderQr().solve(missing);
  for (int k = 0; k < kTerms; ++k) terms[static_cast<std::size_t>(k + 1)].weight_per_m = weights[k];
  return terms;
}

}  // namespace plumescout::lab
