// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// Whether our own strategy maps gas better than those of the paper in buildings that it was not
// tuned in: 20 generated ones (seeds 901 to 920), two trials of 300 s each. Measured against the
// oracle that places as many readings knowing everything (see PlaceReadings): the share of the
// oracle's gain over RRT* frontier exploration that a strategy reaches. With options.scenes: in
// these. Quick: buildings 1 and 2, one trial of 60 s. Errors: as GeneratedScenes, RunTrials and
// PlaceReadings.
absl::StatusOr<Study> RunOwnStrategy(const ExperimentOptions& options);

}  // namespace plumescout::lab
