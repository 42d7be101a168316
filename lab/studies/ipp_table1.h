// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [IPP] Table I with Fig. 3 and 4: a lawnmower sweep and the five rewards, from ten places in a
// quarter of streets and blocks whose map is known, for 10,000 s each. The paper's gas (DAPPLE) is
// not public; the quarter is ours. options.trials: starts. Quick: two starts, 2000 s. Errors: as
// MakeQuarterWorld and RunSamplingStudy.
absl::StatusOr<Study> RunIppTable1(const ExperimentOptions& options);

}  // namespace plumescout::lab
