// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/dwell_sensor.h"

#include <algorithm>
#include <cmath>

namespace plumescout::lab {
namespace {

// Midpoint rule, at least once a second.
double MeanConcentration_ppm(const SceneWorld& world, const Dwell& dwell) {
  constexpr double kStep_s = 1.0;
  const double duration_s = dwell.end_s - dwell.begin_s;
  const int steps = std::max(1, static_cast<int>(std::ceil(duration_s / kStep_s)));
  double sum_ppm = 0.0;
  for (int i = 0; i < steps; ++i) {
    sum_ppm += world.Concentration_ppm(dwell.place, dwell.begin_s + (i + 0.5) / steps * duration_s);
  }
  return sum_ppm / steps;
}

}  // namespace

DwellSensor MakeDwellSensor(const SceneWorld& world, const DwellNoise& noise) {
  return [&world, noise](const Dwell& dwell, Rng& rng) {
    const double true_ppm = MeanConcentration_ppm(world, dwell);
    const double sigma_ppm = std::hypot(noise.sigma_ppm, noise.share * true_ppm,
                                        std::sqrt(noise.variance_per_ppm * true_ppm));
    GasReading reading{std::max(0.0, true_ppm + sigma_ppm * rng.Gaussian()), 0.0};
    if (noise.variance_per_ppm > 0.0) {
      reading.variance_ppm2 =
          std::max(noise.least_told_ppm2, noise.variance_per_ppm * reading.concentration_ppm);
    }
    return reading;
  };
}

}  // namespace plumescout::lab
