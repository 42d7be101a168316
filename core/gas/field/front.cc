// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/front.h"

#include <algorithm>
#include <numeric>

#include "core/gas/field/prefetch.h"

namespace plumescout {
namespace {

// y += a x for a column-major `a`; four columns at once, to load and store y less often.
void AddProduct(const double* a, std::size_t rows, std::span<const double> x, double* y) {
  std::size_t j = 0;
  for (; j + 4 <= x.size(); j += 4, a += 4 * rows) {
    const double *a0 = a, *a1 = a0 + rows, *a2 = a1 + rows, *a3 = a2 + rows;
    const double x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
    for (std::size_t i = 0; i < rows; ++i) {
      y[i] += (a0[i] * x0 + a1[i] * x1) + (a2[i] * x2 + a3[i] * x3);
    }
  }
  for (; j < x.size(); ++j, a += rows) {
    for (std::size_t i = 0; i < rows; ++i) y[i] += a[i] * x[j];
  }
}

}  // namespace

void Front::AddCovariance(std::span<const double> own_values, double* result) const {
  const double* column = covariance.data();
  for (std::size_t j = 0; j < own; ++j) {
    const double x = own_values[j];
    result[j] += Dot(column, own_values.data() + j, own - j);
    for (std::size_t i = 1; i < own - j; ++i) result[j + i] += column[i] * x;
    column += own - j;
  }
}

void Front::AddWeighted(std::span<const double> boundary_values, std::vector<double>& scratch,
                        double* result) const {
  if (couplings.empty()) {
    if (!weights.empty()) AddProduct(weights.data(), own, boundary_values, result);
    return;
  }
  scratch.assign(own, 0.0);
  for (const Coupling& coupling : couplings) {
    scratch[coupling.own] += coupling_precision * boundary_values[coupling.boundary];
  }
  AddCovariance(scratch, result);
}

void Front::SumWeights() {
  weight_sums.assign(own, 0.0);
  std::vector<double> scratch;
  AddWeighted(std::vector<double>(boundary(), 1.0), scratch, weight_sums.data());
}

const double* Front::Weights(std::vector<double>& scratch) const {
  if (couplings.empty()) return weights.data();
  scratch.assign(own * boundary() + kRowTile, 0.0);
  for (const Coupling& coupling : couplings) {
    double* const column = scratch.data() + coupling.boundary * own;
    const double* value = covariance.data() + coupling.own;  // along the row of C to its diagonal
    for (std::size_t i = 0; i < coupling.own; ++i) {
      column[i] += coupling_precision * *value;
      value += own - i - 1;
    }
    for (std::size_t i = coupling.own; i < own; ++i) column[i] += coupling_precision * *value++;
  }
  return scratch.data();
}

void Front::Prefetch() const {
  PrefetchBytes(cells.data(), cells.size() * sizeof(Slot));
  PrefetchBytes(covariance.data(), covariance.size() * sizeof(double));
  PrefetchBytes(weights.data(), weights.size() * sizeof(double));
  PrefetchBytes(couplings.data(), couplings.size() * sizeof(Coupling));
}

double Front::work() const {
  const auto cube = [](double n) { return n * n * n / 6.0; };
  return cube(static_cast<double>(cells.size())) - cube(static_cast<double>(boundary()));
}

void Condition(const Front& front, std::span<const double> weights, PathStep& step) {
  const std::span<const double> own = weights.first(front.own);
  step.own.assign(front.own, 0.0);
  front.AddCovariance(own, step.own.data());
  step.variance_ppm2 += Dot(own.data(), step.own.data(), front.own);
  step.mean_ppm += Dot(own.data(), front.offset_ppm.data(), front.own);
  step.boundary.assign(weights.begin() + static_cast<std::ptrdiff_t>(front.own), weights.end());
  for (const Front::Coupling& coupling : front.couplings) {
    step.boundary[coupling.boundary] += front.coupling_precision * step.own[coupling.own];
  }
  if (front.weights.empty()) return;
  for (std::size_t j = 0; j < step.boundary.size(); ++j) {
    step.boundary[j] += Dot(front.weights.data() + j * front.own, own.data(), front.own);
  }
}

// Sherman and Morrison on the joint distribution of S and cell i given R, of which W is the
// derivative of the means.
std::shared_ptr<const Front> AfterReading(const Front& front, const PathStep& step,
                                          double precision, double weighted_deviation) {
  auto after = std::make_shared<Front>();
  after->cells = front.cells;
  after->own = front.own;
  after->covariance = front.covariance;
  after->weights = front.weights;
  after->couplings = front.couplings;
  after->coupling_precision = front.coupling_precision;
  after->offset_ppm = front.offset_ppm;
  after->weight_sums = front.weight_sums;
  const std::size_t own = front.own;
  const double scale = 1.0 / (1.0 + precision * step.variance_ppm2);
  const double gain = (weighted_deviation - precision * step.mean_ppm) * scale;
  const double weights_sum = std::accumulate(step.boundary.begin(), step.boundary.end(), 0.0);
  for (std::size_t i = 0; i < own; ++i) {
    after->offset_ppm[i] += gain * step.own[i];
    after->weight_sums[i] -= precision * scale * weights_sum * step.own[i];
  }
  double* column = after->covariance.data();
  for (std::size_t j = 0; j < own; ++j) {
    const double factor = precision * scale * step.own[j];
    for (std::size_t i = j; i < own; ++i) *column++ -= factor * step.own[i];
  }
  if (front.weights.empty()) return after;
  column = after->weights.data();
  for (const double weight : step.boundary) {
    const double factor = precision * scale * weight;
    for (std::size_t i = 0; i < own; ++i) *column++ -= factor * step.own[i];
  }
  return after;
}

void FindPlaces(std::span<const Slot> some, std::span<const Slot> all,
                std::vector<std::uint32_t>& places) {
  places.resize(some.size());
  std::uint32_t place = 0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    while (all[place] != some[i]) ++place;
    places[i] = place;
  }
}

}  // namespace plumescout
