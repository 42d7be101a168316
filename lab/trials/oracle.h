// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "core/types/options.h"
#include "lab/formats/scene.h"
#include "lab/sim/metrics.h"

namespace plumescout::lab {

// What the oracle wants of its next reading.
enum class OracleAim {
  kEntropy,  // least entropy, [XIT] Eq. (24)
  kError,    // least squared error, Eq. (23)
};

// The best that `readings` gas readings could do if somebody who knows building and gas placed them
// one by one where each helps most, without having to drive there: a bound for planners to be
// measured against. Readings are of the time mean, without noise, in critical cells; the field is
// the mission's over all free cells. Greedy, so not quite the optimum: within 1 - 1/e of it for the
// entropy, which is submodular.
//
// Errors: kInvalidArgument for a scene without critical cells; as SparseCholesky. Memory: 4 bytes
// times the square of the critical cells, 250 MB for 8000; of more than that every k-th is taken.
// Cost: O(readings * critical cells^2), 30 s for 600 and 8000.
absl::StatusOr<MapMetrics> PlaceReadings(const Scene& scene, const GasOptions& gas, int readings,
                                         OracleAim aim);

}  // namespace plumescout::lab
