// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/field/pending_reading.h"

#include <algorithm>

namespace plumescout {

void CorrectColumns(const PendingReadings& pending, std::span<const Slot> slots,
                    std::span<const double> mixing, SlotColumns& columns) {
  const std::size_t size = slots.size();
  std::vector<double> scale(size);
  for (const auto& reading : pending) {
    const double* const heard = reading->column.row(0);
    std::fill(scale.begin(), scale.end(), 0.0);
    for (std::size_t i = 0; i < size; ++i) {
      const double factor = reading->variance_factor * heard[slots[i]];
      for (std::size_t j = 0; j < size; ++j) scale[j] += factor * mixing[i * size + j];
    }
    double* x = columns.row(0);
    if (size == 1) {  // a loop that the compiler vectorises
      for (std::size_t slot = 0; slot < columns.slots(); ++slot) x[slot] -= heard[slot] * scale[0];
      continue;
    }
    for (std::size_t slot = 0; slot < columns.slots(); ++slot) {
      for (std::size_t j = 0; j < size; ++j) *x++ -= heard[slot] * scale[j];
    }
  }
}

double Mean_ppm(const FieldFactor& factor, const PendingReadings& pending, Slot slot) {
  double mean = factor.Mean_ppm(slot);
  for (const auto& reading : pending) {
    mean += reading->mean_factor * *reading->column.row(slot);
  }
  return mean;
}

}  // namespace plumescout
