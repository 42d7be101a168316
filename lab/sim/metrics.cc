// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/grid/flood.h"

namespace plumescout::lab {
namespace {

struct Estimate {
  double mean_ppm = 0.0;
  double variance_ppm2 = 0.0;
};

Estimate EstimateAt(const MapSnapshot& map, Point2 point, const Estimate& prior) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const double mean = map.gas_mean_ppm.At(map.gas_mean_ppm.geometry().CellAt(point), kNone);
  const double variance =
      map.gas_variance_ppm2.At(map.gas_variance_ppm2.geometry().CellAt(point), kNone);
  const bool known = std::isfinite(mean) && std::isfinite(variance) && variance > 0.0;
  return known ? Estimate{mean, variance} : prior;
}

Grid<std::uint8_t> FreeCells(const Scene& scene) {
  Grid<std::uint8_t> free(scene.geometry());
  for (std::size_t i = 0; i < free.size(); ++i) {
    free[i] = scene.occupancy[i] == CellState::kFree ? 1 : 0;
  }
  return free;
}

double Ratio(double part, std::size_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN() : part / static_cast<double>(whole);
}

}  // namespace

MapEvaluator::MapEvaluator(const Scene& scene, double prior_variance_ppm2, double ambient_ppm)
    : prior_variance_ppm2_(prior_variance_ppm2), ambient_ppm_(ambient_ppm) {
  const GridGeometry& geometry = scene.geometry();
  const Grid<std::uint8_t> free = FreeCells(scene);
  const Grid<std::uint8_t> reachable =
      ReachableCells(free, {geometry.CellAt(scene.start_pose.position())}, Connectivity::kFour);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Point2 center = geometry.Center(geometry.CellAtIndex(i));
    if (reachable[i] != 0) reachable_.push_back(center);
    const double truth_ppm = scene.conc_mean_ppm[i];
    if (free[i] != 0 && truth_ppm > scene.critical_threshold_ppm) {
      critical_.push_back({center, ambient_ppm + truth_ppm});
    }
  }
}

MapMetrics MapEvaluator::Evaluate(const MapSnapshot& map) const {
  const auto known_free = std::count_if(reachable_.begin(), reachable_.end(), [&](Point2 center) {
    const Cell cell = map.occupancy.geometry().CellAt(center);
    return map.occupancy.At(cell, CellState::kUnknown) == CellState::kFree;
  });
  double squares = 0.0;
  double squares_zero = 0.0;
  double entropy = critical_.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  const GasQuality& quality = map.gas_quality;
  const Estimate prior{
      ambient_ppm_, prior_variance_ppm2_ * quality.clean_air_scale / quality.prior_precision_scale};
  for (const CriticalCell& cell : critical_) {
    const Estimate estimate = EstimateAt(map, cell.center, prior);
    const double error = estimate.mean_ppm - cell.truth_ppm;
    const double excess = cell.truth_ppm - ambient_ppm_;
    squares += error * error;
    squares_zero += excess * excess;
    entropy += 0.5 * std::log(2.0 * M_PI * M_E * estimate.variance_ppm2);
  }
  MapMetrics metrics;
  metrics.completeness = Ratio(static_cast<double>(known_free), reachable_.size());
  metrics.rmse_ppm = std::sqrt(Ratio(squares, critical_.size()));
  metrics.rmse_zero_ppm = std::sqrt(Ratio(squares_zero, critical_.size()));
  metrics.entropy_nats = entropy;
  metrics.critical_cells = static_cast<int>(critical_.size());
  return metrics;
}

}  // namespace plumescout::lab
