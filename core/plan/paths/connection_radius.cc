// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/connection_radius.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumescout {

double ConnectionRadius_m(double area_m2, int samples, double resolution_m,
                          const PlanningOptions& options) {
  constexpr double kDimensions = 2.0;
  constexpr double kUnitBall = std::numbers::pi;  // xi_2
  const double gamma_rgg =                        // Eq. (7)
      2.0 * std::sqrt(1.0 + 1.0 / kDimensions) * std::sqrt(area_m2 / kUnitBall);
  const bool widen = options.mixture_radius && options.uniform_share > 0.0;
  const double gamma =
      options.radius_factor * gamma_rgg * (widen ? 1.0 / std::sqrt(options.uniform_share) : 1.0);
  const double n = std::max(samples, 1);
  const double radius_m = gamma * std::sqrt(std::log(n) / n);
  const double limit_m = options.max_connection_radius_m;
  const double limited_m = limit_m > 0.0 ? std::min(radius_m, limit_m) : radius_m;
  return std::max(limited_m, kMinRadius_cells * resolution_m);
}

}  // namespace plumescout
