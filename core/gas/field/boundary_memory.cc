// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/boundary_memory.h"

#include <cmath>

namespace plumescout {

void BoundaryMemory::Remember(const BoundaryField& boundary) {
  const std::size_t size = boundary.mean_ppm.size();
  mean_ppm_.assign(boundary.mean_ppm.begin(), boundary.mean_ppm.end());
  covariance_ppm2_.clear();
  covariance_ppm2_.reserve(size * (size + 1) / 2);
  for (std::size_t j = 0; j < size; ++j) {
    const double* const column = boundary.covariance_ppm2.data() + j * size;
    covariance_ppm2_.insert(covariance_ppm2_.end(), column + j, column + size);
  }
}

FieldShift BoundaryMemory::Moved(const BoundaryField& boundary) const {
  const std::size_t size = boundary.mean_ppm.size();
  FieldShift moved;
  const double* old = covariance_ppm2_.data();
  for (std::size_t j = 0; j < size; ++j) {
    moved.mean_ppm = std::max(moved.mean_ppm, std::abs(boundary.mean_ppm[j] - mean_ppm_[j]));
    const double* const column = boundary.covariance_ppm2.data() + j * size;
    double most = 0.0;
    for (std::size_t i = j; i < size; ++i) most = std::max(most, std::abs(column[i] - *old++));
    moved.covariance_ppm2 = std::max(moved.covariance_ppm2, most);
  }
  return moved;
}

void BoundaryMemory::Hear(const ReadingFactors& factors, std::span<const double> x) {
  double* covariance = covariance_ppm2_.data();
  for (std::size_t j = 0; j < x.size(); ++j) {
    mean_ppm_[j] += factors.mean_factor * x[j];
    const double scale = factors.variance_factor * x[j];
    const double* const rest = x.data() + j;
    for (std::size_t i = 0; i < x.size() - j; ++i) covariance[i] -= scale * rest[i];
    covariance += x.size() - j;
  }
}

}  // namespace plumescout
