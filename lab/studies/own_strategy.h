// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// Whether our own strategy maps gas better than those of the paper in buildings that it was not
// tuned in: 30 generated ones (seeds 984 to 1013), two trials of 300 s each. All rows map in the
// field of [XIT], but for the last: our strategy as missions have it, in the default field, with
// the sensor's lag undone along the way. Measured against the oracle that places as many readings
// knowing everything, in the field of [XIT] (see PlaceReadings): the share of the oracle's gain
// over RRT* frontier exploration that a row reaches. Entropies of all rows are of that field:
// those of another have another unit. With options.scenes: in these. Quick: buildings 1 and 2, one
// trial of 60 s. Errors: as GeneratedScenes, RunTrials and PlaceReadings.
absl::StatusOr<Study> RunOwnStrategy(const ExperimentOptions& options);

}  // namespace plumescout::lab
