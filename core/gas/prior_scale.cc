// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/prior_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "core/gas/ageing.h"
#include "core/gas/coarse_prior.h"

namespace plumescout {
namespace {

// r^T H^-1 r.
double EnergyOf(const FieldEngine& field, const std::vector<double>& r) {
  const std::vector<double> solution = field.Solve(r);
  return std::inner_product(r.begin(), r.end(), solution.begin(), 0.0);
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
    fit.data += e.evidence.count;
  }
  fit.readings = static_cast<double>(inputs.counters().in_posterior);
  // What has grown old says less of what there is now, and deviates by less of its variance.
  if (Ageing(gas).enabled()) {
    fit.readings = std::min(fit.readings, precision / gas.observation_precision_per_ppm2);
    fit.data = fit.readings;
  }
  fit.data = std::max(fit.data, fit.readings);  // of states that did not count them
  return fit;
}

PriorFit PriorFitOf(const FieldEngine& field, const GasLattice& lattice, const GasInputs& inputs,
                    const GasOptions& gas) {
  PriorFit fit{FitOf(field, lattice, inputs, gas)};
  std::vector<double> rest(field.cells());
  for (std::size_t i = 0; i < field.cells(); ++i) {
    const CellInput input = field.input(i);
    if (!input.active || input.precision == 0.0) continue;
    const double mean = field.mean_ppm(i);
    rest[i] = input.weighted_deviation - input.precision * mean;
    fit.prior_energy += mean * rest[i];
    const double freedom = input.precision * field.variance_ppm2(i);
    fit.freedoms += freedom;
    fit.squared_freedoms += freedom * freedom;
  }
  fit.response = EnergyOf(field, rest);
  return fit;
}

double LogSlope(const PriorFit& fit, double theta) {
  const double energy = std::max(0.0, fit.energy);
  const double prior_energy = std::clamp(fit.prior_energy, 0.0, energy);
  const double pull = (4.0 + fit.data) / (2.0 + energy) * prior_energy;
  return 0.5 * (fit.freedoms - pull) - std::log(theta) / (kPriorLogStddev * kPriorLogStddev);
}

double LogCurvature(const PriorFit& fit) {
  const double n = 4.0 + fit.data;
  const double energy = 2.0 + std::max(0.0, fit.energy);
  const double share = fit.prior_energy / energy;
  const double observed = fit.freedoms - fit.squared_freedoms +
                          n * ((fit.prior_energy - 2.0 * fit.response) / energy - share * share);
  const double expected = fit.squared_freedoms - fit.freedoms * fit.freedoms / n;
  return 0.5 * std::max({0.0, observed, expected}) + 1.0 / (kPriorLogStddev * kPriorLogStddev);
}

PriorScale Improved(const PriorScale& now, const PriorFit& fit, std::int64_t readings) {
  const double curvature = LogCurvature(fit);
  const double log_stddev = 1.0 / std::sqrt(curvature);
  const double step = std::clamp(LogSlope(fit, now.theta) / curvature, -kMostLogStep, kMostLogStep);
  const double most = std::min(kMostPriorScale, NoiseScale(fit));
  const double wanted = now.theta * std::exp(step);
  const double theta = std::clamp(wanted, kLeastPriorScale, most);
  const bool is_worth_it = std::abs(std::log(theta / now.theta)) >= kLeastStepShare * log_stddev;
  const bool is_cut_short = std::abs(step) == kMostLogStep && theta == wanted;
  if (is_cut_short) readings = 2 * (readings + kFirstLesson) / 3;  // see IsLessonDue
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
