// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/gaussian_plume.h"

#include <cmath>

#include "lab/sim/ageing_depth.h"
#include "lab/sim/plume.h"

namespace plumescout::lab {
namespace {

double Normal(double y, double variance) {
  return std::exp(-0.5 * y * y / variance) / std::sqrt(2.0 * M_PI * variance);
}

}  // namespace

double GaussianPlume::At_ppm(double x_m, double y_m) const {
  const double age_s = x_m / wind_mps;
  const double variance_m2 =
      FilamentVariance_m2(gas, age_s) + 2.0 * gas.diffusivity_m2_per_s * age_s;
  const double release_ppm_m3_per_s = FilamentContent_ppm_m3(source, gas) * gas.filaments_per_s;
  return release_ppm_m3_per_s / (wind_mps * DepthAtAge_m(gas, age_s)) * Normal(y_m, variance_m2);
}

double GaussianPlume::Tolerance(double x_m, double y_m, double passed) const {
  const double age_s = x_m / wind_mps;
  const double cloud_m2 = FilamentVariance_m2(gas, age_s);
  const double walk_m2 = 2.0 * gas.diffusivity_m2_per_s * age_s;
  const double variance_m2 = cloud_m2 + walk_m2;
  const double square = Normal(y_m, cloud_m2 / 2.0 + walk_m2) / (2.0 * std::sqrt(M_PI * cloud_m2));
  const double noise = std::sqrt((square / std::pow(Normal(y_m, variance_m2), 2.0) - 1.0) / passed);
  const double diffusivity = gas.diffusivity_m2_per_s + gas.growth_m2_per_s / 2.0;
  const double along_wind = diffusivity / (wind_mps * x_m) * (1.0 + y_m * y_m / variance_m2);
  constexpr double kDeviations = 4.0;
  const double cut_off = std::exp(-4.5);  // beyond 3 sigma of a filament
  return kDeviations * noise + along_wind + cut_off;
}

}  // namespace plumescout::lab
