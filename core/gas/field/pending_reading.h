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

// Columns of the factor's inverse in `slots`, combined by `mixing` (slots x slots, by rows), become
// those of the covariance after the pending readings.
void CorrectColumns(const PendingReadings& pending, std::span<const Slot> slots,
                    std::span<const double> mixing, SlotColumns& columns);

// Mean of an active cell after the pending readings, as deviation from m_0.
double Mean_ppm(const FieldFactor& factor, const PendingReadings& pending, Slot slot);

}  // namespace plumescout
