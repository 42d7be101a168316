// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [IPP] Table I with Fig. 2 to 4: a lawnmower sweep and the five rewards, from ten places in each
// of ten quarters of streets and blocks whose map is known, for 10,000 s each, at 1 and at 3 m/s.
// The paper's gas (DAPPLE) is not public; the quarters are ours, of seeds options.seed + 10 and on.
// options.trials: quarters. Quick: one quarter, two starts, 2000 s. Errors: as MakeQuarterWorld and
// RunSamplingStudy.
absl::StatusOr<Study> RunIppTable1(const ExperimentOptions& options);

}  // namespace plumescout::lab
