// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/map_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace plumescout::lab {

MapCalibration Calibrate(const Scene& truth, const Grid<float>& mean_ppm,
                         const Grid<float>& variance_ppm2, double ambient_ppm) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  MapCalibration sums;
  double cells = 0.0;
  double all_estimated = 0.0;
  for (std::size_t i = 0; i < truth.occupancy.size(); ++i) {
    const double excess_ppm = truth.conc_mean_ppm[i];
    const double true_ppm = ambient_ppm + excess_ppm;
    if (truth.occupancy[i] != CellState::kFree) continue;
    const Point2 place = truth.geometry().Center(truth.geometry().CellAtIndex(i));
    const Cell cell = mean_ppm.geometry().CellAt(place);
    const auto known_ppm = static_cast<double>(mean_ppm.At(cell, kNone));
    const double said_ppm = std::isfinite(known_ppm) ? std::max(0.0, known_ppm) : ambient_ppm;
    const double error_ppm = said_ppm - true_ppm;
    const double log_error = std::log1p(said_ppm) - std::log1p(true_ppm);
    if (std::isfinite(known_ppm)) {
      all_estimated += 1.0;
      sums.log_rmse_all += log_error * log_error;
    }
    if (excess_ppm <= truth.critical_threshold_ppm) continue;
    cells += 1.0;
    sums.rmse_ppm += error_ppm * error_ppm;
    sums.log_rmse += log_error * log_error;
    const auto variance = static_cast<double>(variance_ppm2.At(cell, kNone));
    if (!std::isfinite(known_ppm) || !(variance > 0.0)) continue;
    const double z2 = (known_ppm - true_ppm) * (known_ppm - true_ppm) / variance;
    ++sums.estimated_cells;
    sums.nlpd_nats += 0.5 * (std::log(2.0 * M_PI * variance) + z2);
    sums.within_1_sigma += z2 <= 1.0 ? 1.0 : 0.0;
    sums.within_2_sigma += z2 <= 4.0 ? 1.0 : 0.0;
    sums.rms_z += z2;
  }
  const double estimated = sums.estimated_cells;
  return {.rmse_ppm = std::sqrt(sums.rmse_ppm / cells),
          .log_rmse = std::sqrt(sums.log_rmse / cells),
          .log_rmse_all = std::sqrt(sums.log_rmse_all / all_estimated),
          .nlpd_nats = sums.nlpd_nats / estimated,
          .within_1_sigma = sums.within_1_sigma / estimated,
          .within_2_sigma = sums.within_2_sigma / estimated,
          .rms_z = std::sqrt(sums.rms_z / estimated),
          .estimated_cells = sums.estimated_cells};
}

}  // namespace plumescout::lab
