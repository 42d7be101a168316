// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/prior_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/gas/ageing.h"
#include "core/gas/coarse_prior.h"
#include "core/types/rng.h"

namespace plumescout {
namespace {

// The same signs for the same cells, so that the same events give the same bytes.
std::vector<double> RandomSigns(std::size_t count) {
  constexpr std::uint64_t kSeed = 1;
  Rng rng(kSeed);
  std::vector<double> signs(count);
  for (double& sign : signs) sign = (rng.Next() >> 63) == 0 ? 1.0 : -1.0;
  return signs;
}

double SquaredFreedoms(const FieldEngine& field) {
  std::vector<double> right_side = RandomSigns(field.cells());
  std::vector<double> precisions(field.cells());
  for (std::size_t i = 0; i < right_side.size(); ++i) {
    const CellInput input = field.input(i);
    precisions[i] = input.active ? input.precision : 0.0;
    right_side[i] *= std::sqrt(precisions[i]);
  }
  const std::vector<double> solution = field.Solve(right_side);
  double sum = 0.0;
  for (std::size_t i = 0; i < solution.size(); ++i) {
    if (precisions[i] > 0.0) sum += precisions[i] * solution[i] * solution[i];
  }
  return sum;
}

}  // namespace

FieldFit FitOf(const FieldEngine& field, const GasLattice& lattice, const GasInputs& inputs,
               const GasOptions& gas) {
  FieldFit fit;
  double precision = 0.0;
  for (const CellEvidence& e : inputs.AllEvidence()) {
    const std::size_t cell = lattice.Index(GasCellOf(e.cell, inputs.factor()));
    const double mean_ppm = field.mean_ppm(cell);
    const double energy = e.evidence.weighted_square - e.evidence.weighted_deviation * mean_ppm;
    fit.energy += energy;
    fit.level_energy += energy / LevelScale(gas, mean_ppm);
    precision += e.evidence.precision;
  }
  fit.readings = static_cast<double>(inputs.counters().in_posterior);
  // What has grown old says less of what there is now, and deviates by less of its variance.
  if (Ageing(gas).enabled()) {
    fit.readings = std::min(fit.readings, precision / gas.observation_precision_per_ppm2);
  }
  return fit;
}

PriorFit PriorFitOf(const FieldEngine& field, const GasLattice& lattice, const GasInputs& inputs,
                    const GasOptions& gas) {
  PriorFit fit{FitOf(field, lattice, inputs, gas)};
  for (std::size_t i = 0; i < field.cells(); ++i) {
    const CellInput input = field.input(i);
    if (!input.active || input.precision == 0.0) continue;
    const double mean = field.mean_ppm(i);
    fit.prior_energy += mean * (input.weighted_deviation - input.precision * mean);
    fit.freedoms += input.precision * field.variance_ppm2(i);
  }
  fit.squared_freedoms = SquaredFreedoms(field);
  return fit;
}

double LogSlope(const PriorFit& fit, double theta) {
  const double energy = std::max(0.0, fit.energy);
  const double prior_energy = std::clamp(fit.prior_energy, 0.0, energy);
  const double pull = (4.0 + fit.readings) / (2.0 + energy) * prior_energy;
  return 0.5 * (fit.freedoms - pull) - std::log(theta) / (kPriorLogStddev * kPriorLogStddev);
}

PriorScale Improved(const PriorScale& now, const PriorFit& fit, std::int64_t readings) {
  const double shared = fit.freedoms * fit.freedoms / (4.0 + fit.readings);
  const double curvature = 0.5 * std::max(0.0, fit.squared_freedoms - shared) +
                           1.0 / (kPriorLogStddev * kPriorLogStddev);
  const double log_stddev = 1.0 / std::sqrt(curvature);
  const double step = std::clamp(LogSlope(fit, now.theta) / curvature, -kMostLogStep, kMostLogStep);
  const double most = std::min(kMostPriorScale, NoiseScale(fit));
  const double theta = std::clamp(now.theta * std::exp(step), kLeastPriorScale, most);
  const bool is_worth_it = std::abs(std::log(theta / now.theta)) >= kLeastStepShare * log_stddev;
  return {is_worth_it ? theta : now.theta, log_stddev, readings};
}

NoiseEstimate NoiseOf(const FieldFit& fit, const PriorScale& prior) {
  // Of an inverse gamma distribution ln s has the variance psi'(a), nearly 1 / (a - 1/2).
  const double log_stddev = 1.0 / std::sqrt(1.5 + 0.5 * fit.readings);
  return {std::max(NoiseScale(fit), prior.theta), log_stddev,
          NoiseScale({.energy = fit.level_energy, .readings = fit.readings})};
}

GasOptions WithPriorScale(GasOptions gas, const PriorScale& prior) {
  gas.prior_precision_per_ppm2 *= prior.theta;
  gas.background_precision_per_ppm2 = BackgroundPrecision_per_ppm2(gas) * prior.theta;
  return gas;
}

FieldPrior PriorOf(const GasOptions& gas, const PriorScale& prior) {
  const GasOptions scaled = WithPriorScale(gas, prior);
  return {.prior_precision_per_ppm2 = scaled.prior_precision_per_ppm2,
          .background_precision_per_ppm2 = scaled.background_precision_per_ppm2};
}

}  // namespace plumescout
