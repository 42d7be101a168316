// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/worlds/decaying_plume.h"

#include <algorithm>
#include <cmath>

namespace plumescout::lab {

double DecayingPlume::PerRate_s_per_m3(double downwind_m, double crosswind_m) const {
  const double diffusivity = diffusivity_m2_per_s;
  const double range_m = std::sqrt(diffusivity * lifetime_s /
                                   (1.0 + wind_mps * wind_mps * lifetime_s / (4.0 * diffusivity)));
  const double distance_m = std::max(particle_radius_m, std::hypot(downwind_m, crosswind_m));
  const double exponent = wind_mps * downwind_m / (2.0 * diffusivity) - distance_m / range_m;
  return std::exp(exponent) / (4.0 * M_PI * diffusivity * distance_m);
}

}  // namespace plumescout::lab
