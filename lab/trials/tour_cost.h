// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "absl/status/statusor.h"

namespace plumescout::lab {

// What the two programs of [LHR] cost, CPU time of one core.
struct TourCost {
  double subsets_ms = 0.0;  // (P2): 10 of 15 cells, 3003 subsets
  double survey_ms = 0.0;   // (P1): a mesh of 6 x 6 points
};

// Medians of some runs; `seed` draws the cells.
absl::StatusOr<TourCost> MeasureTourCost(std::uint64_t seed);

}  // namespace plumescout::lab
