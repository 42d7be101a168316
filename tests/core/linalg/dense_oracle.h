// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/linalg/symmetric_matrix.h"
#include "core/types/rng.h"

namespace plumescout::testing {

inline Eigen::MatrixXd ToDense(const SymmetricMatrix& matrix) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(matrix.n, matrix.n);
  for (int j = 0; j < matrix.n; ++j) {
    const auto column = static_cast<std::size_t>(j);
    for (int k = matrix.column_start[column]; k < matrix.column_start[column + 1]; ++k) {
      const int i = matrix.row[static_cast<std::size_t>(k)];
      dense(i, j) = dense(j, i) = matrix.value[static_cast<std::size_t>(k)];
    }
  }
  return dense;
}

// Random positive definite matrix: about `share` of the pairs are coupled, with either sign, and
// the diagonal exceeds the sum of its row by [0.1, 1.1). Pieces may be disconnected.
inline SymmetricMatrix RandomPositiveDefinite(int n, double share, Rng& rng) {
  std::vector<Triplet> triplets;
  for (int j = 0; j < n; ++j) {
    triplets.push_back({j, j, rng.Uniform(0.1, 1.1)});
    for (int i = j + 1; i < n; ++i) {
      if (rng.Uniform01() >= share) continue;
      const double value = rng.Uniform(-2.0, 2.0);
      triplets.push_back({i, j, value});
      triplets.push_back({i, i, std::abs(value)});
      triplets.push_back({j, j, std::abs(value)});
    }
  }
  return SymmetricFromTriplets(n, triplets).value();
}

// 5-point Laplacian of a width x height grid plus `shift` on the diagonal: fronts of many sizes.
inline SymmetricMatrix GridLaplacian(int width, int height, double shift) {
  std::vector<Triplet> triplets;
  for (int i = 0; i < width * height; ++i) {
    triplets.push_back({i, i, shift});
    const auto couple = [&](int j) {
      triplets.push_back({j, i, -1.0});
      triplets.push_back({i, i, 1.0});
      triplets.push_back({j, j, 1.0});
    };
    if (i % width + 1 < width) couple(i + 1);
    if (i / width + 1 < height) couple(i + width);
  }
  return SymmetricFromTriplets(width * height, triplets).value();
}

inline std::vector<double> RandomVector(int n, Rng& rng) {
  std::vector<double> values(static_cast<std::size_t>(n));
  for (double& value : values) value = rng.Uniform(-1.0, 1.0);
  return values;
}

}  // namespace plumescout::testing
