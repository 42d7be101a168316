// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [XIT] Table III with Fig. 8 and 9: five configurations of XIT and the RRT* frontier baseline to
// the letter, 20 trials of 300 s each, in a hall of ours of the paper's size, or in options.scenes.
// Beside them the other reading of the paper's "Euclidean" rows, and ours. All rows start at the
// same pose with the same seeds and the robot of xit_calibration; the paper's baseline stops when
// no frontier is left, all others go on. Of several buildings each counts once. Quick: two trials
// of 60 s. Errors: as HallScene and RunTrials.
absl::StatusOr<Study> RunXitTable3(const ExperimentOptions& options);

}  // namespace plumescout::lab
