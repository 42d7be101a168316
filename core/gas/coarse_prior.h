// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/types/options.h"

namespace plumescout {

// The prior on a lattice whose cells are f = lattice_factor occupancy cells of h metres wide, such
// that it is the field of the full lattice, seen more coarsely. The energy of a field m,
//   lambda_p sum over links (m_i - m_j)^2 + lambda_d sum over cells (m_i - m_0)^2,
// stands for the integral of lambda_p |grad m|^2 + (lambda_d / h^2) (m - m_0)^2 over the ground. A
// link of the coarse lattice has ((m_i - m_j) / (f h))^2 over an area of (f h)^2: in a plane
// lambda_p is the same whatever f. A cell has f^2 times the area: its lambda_d is f^2 lambda_d.
inline double BackgroundPrecision_per_ppm2(const GasOptions& gas) {
  const double area = gas.background_by_area ? gas.lattice_factor * gas.lattice_factor : 1.0;
  return area * gas.background_precision_per_ppm2;
}

// What a place within a gas cell varies by beside the cell, whose variable has no waves that are
// shorter than it is wide. Unread ground has epsilon_inf on the full lattice and on the coarse one
// the same of f^2 lambda_d:
//   (ln(32 lambda_p / lambda_d) - ln(32 lambda_p / (f^2 lambda_d))) / (4 pi lambda_p)
//   = ln f / (2 pi lambda_p).
// With that added, variances and thresholds mean the same on every lattice.
inline double VarianceWithinCell_ppm2(const GasOptions& gas) {
  if (!gas.background_by_area || gas.lattice_factor == 1) return 0.0;
  constexpr double kPi = 3.14159265358979323846;
  return std::log(static_cast<double>(gas.lattice_factor)) /
         (2.0 * kPi * gas.prior_precision_per_ppm2);
}

// Adds it to the variances of so many cells, which may be left out where all are 0.
inline void AddVarianceWithinCells(const GasOptions& gas, std::size_t cells,
                                   std::vector<double>& variances_ppm2) {
  const double within_ppm2 = VarianceWithinCell_ppm2(gas);
  if (within_ppm2 == 0.0) return;
  variances_ppm2.resize(cells, 0.0);
  for (double& variance_ppm2 : variances_ppm2) variance_ppm2 += within_ppm2;
}

}  // namespace plumescout
