// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/formats/scene.h"
#include "lab/sim/layout.h"

namespace plumescout::lab {

// The plume of one source in uniform wind u without walls, at sensor height. With t = x / u,
// sigma^2 = sigma_0^2 + (gamma + 2 K) t and the depth of that age,
//   c(x, y) = release / (u depth sqrt(2 pi) sigma) exp(-y^2 / (2 sigma^2)).
struct GaussianPlume {
  GasSource source;  // its position does not matter
  GasParameters gas;
  double wind_mps = 1.0;

  // `x_m` downwind of the source, `y_m` across. REQUIRES: x_m > 0.
  double At_ppm(double x_m, double y_m) const;

  // How far the mean of `passed` filaments may be from At_ppm there, as a share of it: 4 standard
  // deviations of the mean, what diffuses along the wind, and what is cut off of each filament.
  //
  // A filament that passes adds G(y - eta; s^2), s^2 = sigma_0^2 + gamma t, with eta ~ N(0, 2 K t).
  // As E G^2 = G(y; s^2 / 2 + 2 K t) / (2 s sqrt(pi)), the mean of n has the relative variance
  // (E G^2 / (E G)^2 - 1) / n. Diffusion along the wind is a share D / (u x) (1 + y^2 / sigma^2).
  double Tolerance(double x_m, double y_m, double passed) const;
};

}  // namespace plumescout::lab
