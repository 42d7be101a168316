// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/boundary_memory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/gas/field/prefetch.h"

namespace plumescout {
namespace {

// Readings before they are settled. More would save little, and cost memory on small boundaries.
constexpr std::size_t kMostHeard = 8;

// Largest difference of two elements, in several at once: a maximum is the same in any order.
double LargestDifference(const double* a, const double* b, std::size_t size) {
  constexpr std::size_t kLanes = 8;
  double most[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= size; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double difference = std::abs(a[i + lane] - b[i + lane]);
      most[lane] = difference > most[lane] ? difference : most[lane];
    }
  }
  for (; i < size; ++i) most[0] = std::max(most[0], std::abs(a[i] - b[i]));
  return *std::max_element(most, most + kLanes);
}

}  // namespace

void BoundaryMemory::Remember(const BoundaryField& boundary) {
  const std::size_t size = boundary.mean_ppm.size();
  mean_ppm_.assign(boundary.mean_ppm.begin(), boundary.mean_ppm.end());
  heard_.clear();
  covariance_ppm2_.clear();
  covariance_ppm2_.reserve(size * (size + 1) / 2);
  for (std::size_t j = 0; j < size; ++j) {
    const double* const column = boundary.covariance_ppm2.data() + j * size;
    covariance_ppm2_.insert(covariance_ppm2_.end(), column + j, column + size);
  }
}

FieldShift BoundaryMemory::Moved(const BoundaryField& boundary) {
  Settle();
  const std::size_t size = boundary.mean_ppm.size();
  FieldShift moved;
  moved.mean_ppm = LargestDifference(boundary.mean_ppm.data(), mean_ppm_.data(), size);
  const double* old = covariance_ppm2_.data();
  for (std::size_t j = 0; j < size; ++j) {
    const double* const column = boundary.covariance_ppm2.data() + j * size;
    moved.covariance_ppm2 =
        std::max(moved.covariance_ppm2, LargestDifference(column + j, old, size - j));
    old += size - j;
  }
  return moved;
}

void BoundaryMemory::Hear(const ReadingFactors& factors, std::span<const double> x) {
  for (std::size_t j = 0; j < x.size(); ++j) mean_ppm_[j] += factors.mean_factor * x[j];
  heard_.push_back(factors.variance_factor);
  heard_.insert(heard_.end(), x.begin(), x.end());
  if (heard_.size() >= kMostHeard * (x.size() + 1)) Settle();
}

void BoundaryMemory::PrefetchForMoved() const {
  PrefetchBytes(mean_ppm_.data(), mean_ppm_.size() * sizeof(double));
  PrefetchBytes(covariance_ppm2_.data(), covariance_ppm2_.size() * sizeof(double));
}

void BoundaryMemory::PrefetchForHear() const {
  PrefetchBytes(mean_ppm_.data(), mean_ppm_.size() * sizeof(double));
  PrefetchBytes(heard_.data() + heard_.size(), (mean_ppm_.size() + 1) * sizeof(double));
}

void BoundaryMemory::Settle() {
  const std::size_t size = mean_ppm_.size();
  double* covariance = covariance_ppm2_.data();
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t entry = 0; entry < heard_.size(); entry += size + 1) {
      const double scale = heard_[entry] * heard_[entry + 1 + j];
      const double* const rest = heard_.data() + entry + 1 + j;
      for (std::size_t i = 0; i < size - j; ++i) covariance[i] -= scale * rest[i];
    }
    covariance += size - j;
  }
  heard_.clear();
}

}  // namespace plumescout
