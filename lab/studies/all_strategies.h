// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// Every strategy of the project in the same generated buildings, or in options.scenes: with the
// building unknown, and with its map known beforehand. Beside each what Kernel DM+V makes of the
// same readings. options.trials: by building. Quick: one building, 60 s. Errors: as GeneratedScenes
// and RunTrials.
absl::StatusOr<Study> RunAllStrategies(const ExperimentOptions& options);

}  // namespace plumescout::lab
