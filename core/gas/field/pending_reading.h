// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/gas/field/field_factor.h"

namespace plumescout {

// A reading that the fields have heard and the factor has not: with x the column of the inverse in
// its cell, the covariance Z has become Z - variance_factor x x^T, the mean m + mean_factor x
// (Sherman and Morrison).
struct PendingReading {
  Slot slot = 0;
  SlotColumns column;
  double variance_factor = 0.0;
  double mean_factor = 0.0;
};
using PendingReadings = std::vector<std::shared_ptr<const PendingReading>>;

// Columns of the covariance after the pending readings. REQUIRES: `slots` are active.
SlotColumns CovarianceColumns(const FieldFactor& factor, const PendingReadings& pending,
                              std::span<const Slot> slots);

// Mean of an active cell after the pending readings, as deviation from m_0.
double Mean_ppm(const FieldFactor& factor, const PendingReadings& pending, Slot slot);

}  // namespace plumescout
