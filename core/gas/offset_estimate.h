// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/gas/field/field_engine.h"
#include "core/gas/information.h"

namespace plumescout {

// What the readings of one sensor with an unknown offset say in one cell of a field's lattice.
struct SensorEvidence {
  std::size_t cell = 0;
  Evidence evidence;
};

// An unknown offset beside the field: a reading of the sensor is z = m_c + b + noise.
struct OffsetColumn {
  std::vector<SensorEvidence> cells;      // each at most once; those not active are passed over
  double prior_precision_per_ppm2 = 0.0;  // of b, whose mean is 0; > 0
};

// Offsets and the field that has them as further unknowns.
struct OffsetEstimate {
  std::vector<double> offset_ppm;  // by column
  std::vector<double> stddev_ppm;
  // By how much they lower the energy of all readings, see NoiseScale.
  double explained = 0.0;
  // What comes on top of the field that takes all readings as they are, by lattice cell.
  std::vector<double> mean_ppm;
  std::vector<double> variance_ppm2;  // >= 0
};

// Exactly, with H and h of the field as it is, G the precisions of each sensor's readings by cell,
// D those of the offsets, all added up, and m = H^-1 h:
//   W = H^-1 G,  S = D - G^T W,  b = S^-1 (h_b - G^T m),
//   mean = m - W b,  variance_i = (H^-1)_ii + W_i S^-1 W_i^T.
// REQUIRES: the field has heard these readings. Cost: a pass over the factor for each column, and
// their square by cell.
OffsetEstimate EstimateOffsets(const FieldEngine& field, std::span<const OffsetColumn> columns);

}  // namespace plumescout
