// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/pending_reading.h"

namespace plumescout {

SlotColumns CovarianceColumns(const FieldFactor& factor, const PendingReadings& pending,
                              std::span<const Slot> slots) {
  SlotColumns x = factor.InverseColumns(slots);
  for (const auto& reading : pending) {
    const double* const heard = reading->column.column(0);
    for (std::size_t j = 0; j < slots.size(); ++j) {
      double* const column = x.column(j);
      const double scale = reading->variance_factor * heard[slots[j]];
      for (std::size_t i = 0; i < x.stride(); ++i) column[i] -= scale * heard[i];
    }
  }
  return x;
}

double Mean_ppm(const FieldFactor& factor, const PendingReadings& pending, Slot slot) {
  double mean = factor.Mean_ppm(slot);
  for (const auto& reading : pending) {
    mean += reading->mean_factor * reading->column.column(0)[slot];
  }
  return mean;
}

}  // namespace plumescout
