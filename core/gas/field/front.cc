// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/front.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/gas/field/prefetch.h"

namespace plumescout {
namespace {

typedef double Pair __attribute__((vector_size(16)));

Pair PairAt(const double* values) {
  Pair pair;
  std::memcpy(&pair, values, sizeof(pair));
  return pair;
}

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

// y += C x for a symmetric C, lower triangle packed by columns; four columns at once.
void AddSymmetric(const double* c, std::size_t size, const double* x, double* y) {
  std::size_t j = 0;
  for (; j + 4 <= size; j += 4) {
    const double *c0 = c, *c1 = c0 + (size - j) - 1, *c2 = c1 + (size - j) - 2;
    const double* c3 = c2 + (size - j) - 3;  // so that row i is c0[i], c1[i], ...
    c = c3 + (size - j);
    const std::size_t rows = size - j;
    const double* const u = x + j;
    double* const v = y + j;
    v[0] += (c0[0] * u[0] + c0[1] * u[1]) + (c0[2] * u[2] + c0[3] * u[3]);
    v[1] += (c0[1] * u[0] + c1[1] * u[1]) + (c1[2] * u[2] + c1[3] * u[3]);
    v[2] += (c0[2] * u[0] + c1[2] * u[1]) + (c2[2] * u[2] + c2[3] * u[3]);
    v[3] += (c0[3] * u[0] + c1[3] * u[1]) + (c2[3] * u[2] + c3[3] * u[3]);
    Pair sum0 = {}, sum1 = {}, sum2 = {}, sum3 = {};
    std::size_t i = 4;
    for (; i + 2 <= rows; i += 2) {
      const Pair x2 = PairAt(u + i);
      const Pair a0 = PairAt(c0 + i), a1 = PairAt(c1 + i);
      const Pair a2 = PairAt(c2 + i), a3 = PairAt(c3 + i);
      sum0 += a0 * x2;
      sum1 += a1 * x2;
      sum2 += a2 * x2;
      sum3 += a3 * x2;
      const Pair y2 = PairAt(v + i) + ((a0 * u[0] + a1 * u[1]) + (a2 * u[2] + a3 * u[3]));
      std::memcpy(v + i, &y2, sizeof(y2));
    }
    if (i < rows) {
      sum0[0] += c0[i] * u[i];
      sum1[0] += c1[i] * u[i];
      sum2[0] += c2[i] * u[i];
      sum3[0] += c3[i] * u[i];
      v[i] += (c0[i] * u[0] + c1[i] * u[1]) + (c2[i] * u[2] + c3[i] * u[3]);
    }
    v[0] += sum0[0] + sum0[1];
    v[1] += sum1[0] + sum1[1];
    v[2] += sum2[0] + sum2[1];
    v[3] += sum3[0] + sum3[1];
  }
  for (; j < size; c += size - j, ++j) {
    y[j] += c[0] * x[j];
    for (std::size_t i = 1; i < size - j; ++i) {
      y[j] += c[i] * x[j + i];
      y[j + i] += c[i] * x[j];
    }
  }
}

// y += A^T x for a column-major `a`; four columns at once.
void AddTransposedProduct(const double* a, std::span<const double> x, std::size_t columns,
                          double* y) {
  const std::size_t rows = x.size();
  std::size_t j = 0;
  for (; j + 4 <= columns; j += 4, a += 4 * rows) {
    const double *a0 = a, *a1 = a0 + rows, *a2 = a1 + rows, *a3 = a2 + rows;
    Pair sum0 = {}, sum1 = {}, sum2 = {}, sum3 = {};
    std::size_t i = 0;
    for (; i + 2 <= rows; i += 2) {
      const Pair x2 = PairAt(x.data() + i);
      sum0 += PairAt(a0 + i) * x2;
      sum1 += PairAt(a1 + i) * x2;
      sum2 += PairAt(a2 + i) * x2;
      sum3 += PairAt(a3 + i) * x2;
    }
    if (i < rows) {
      sum0[0] += a0[i] * x[i];
      sum1[0] += a1[i] * x[i];
      sum2[0] += a2[i] * x[i];
      sum3[0] += a3[i] * x[i];
    }
    y[j] += sum0[0] + sum0[1];
    y[j + 1] += sum1[0] + sum1[1];
    y[j + 2] += sum2[0] + sum2[1];
    y[j + 3] += sum3[0] + sum3[1];
  }
  for (; j < columns; ++j, a += rows) y[j] += Dot(a, x.data(), rows);
}

}  // namespace

void Front::AddTransposed(std::span<const double> own_values, std::vector<double>& scratch,
                          double* result) const {
  if (couplings.empty()) {
    if (!weights.empty()) AddTransposedProduct(weights.data(), own_values, boundary(), result);
    return;
  }
  scratch.assign(own, 0.0);
  AddSymmetric(covariance.data(), own, own_values.data(), scratch.data());
  for (const Coupling& coupling : couplings) {
    result[coupling.boundary] += coupling_precision * scratch[coupling.own];
  }
}

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
  scratch.resize(std::max(scratch.size(), own * boundary() + kRowTile));
  for (const Coupling& coupling : couplings) {
    double* const column = scratch.data() + coupling.boundary * own;
    const double* value = covariance.data() + coupling.own;  // along the row of C to its diagonal
    const auto write = [&](std::size_t i) {
      const double weight = coupling_precision * *value;
      column[i] = coupling.is_first ? weight : column[i] + weight;
    };
    for (std::size_t i = 0; i < coupling.own; ++i) {
      write(i);
      value += own - i - 1;
    }
    for (std::size_t i = coupling.own; i < own; ++i, ++value) write(i);
  }
  return scratch.data();
}

void Front::Prefetch() const {
  PrefetchBytes(cells.data(), cells.size() * sizeof(Slot));
  PrefetchBytes(covariance.data(), covariance.size() * sizeof(double));
  PrefetchBytes(weights.data(), weights.size() * sizeof(double));
  PrefetchBytes(couplings.data(), couplings.size() * sizeof(Coupling));
  PrefetchBytes(weight_sums.data(), weight_sums.size() * sizeof(double));
  PrefetchBytes(child_places.data(), child_places.size() * sizeof(std::uint32_t));
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

std::shared_ptr<Front> WithoutMessage(const Front& front) {
  auto copy = std::make_shared<Front>();
  copy->cells = front.cells;
  copy->own = front.own;
  copy->covariance = front.covariance;
  copy->weights = front.weights;
  copy->couplings = front.couplings;
  copy->coupling_precision = front.coupling_precision;
  copy->offset_ppm = front.offset_ppm;
  copy->weight_sums = front.weight_sums;
  copy->child_places = front.child_places;
  return copy;
}

// Sherman and Morrison on the joint distribution of S and cell i given R, of which W is the
// derivative of the means.
std::shared_ptr<const Front> AfterReading(const Front& front, const PathStep& step,
                                          double precision, double weighted_deviation) {
  std::shared_ptr<Front> after = WithoutMessage(front);
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

}  // namespace plumescout
