// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/types/cell_state.h"
#include "core/types/grid.h"

namespace plumescout::lab {

// How alike two maps of concentration are, over free cells.
struct FieldAgreement {
  double log_correlation = 0.0;  // Pearson's of ln max(kFloor_ppm, c); NaN if one does not vary
  double overlap = 0.0;          // of the critical cells: intersection over union; 1 if both empty
  double mean_ratio = 0.0;       // of the means, b over a
};

// What a sensor can detect at least. Below it a mean of filaments hangs on single ones.
inline constexpr double kFloor_ppm = 0.05;

// REQUIRES: all of one geometry, all finite.
FieldAgreement Compare(const Grid<float>& a_ppm, const Grid<float>& b_ppm,
                       const Grid<CellState>& occupancy, double critical_ppm);

}  // namespace plumescout::lab
