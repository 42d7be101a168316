// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [LHR] Table II with Fig. 3 and 4: sweep, constrained random sampling, and the low-to-high
// planner with either reward, with and without its survey, each from four corners in five worlds
// whose sources are drawn around those of Table I, until every site is sampled. options.trials:
// worlds. Quick: one world, one corner. Errors: as RunSamplingStudy.
absl::StatusOr<Study> RunLhrTable2(const ExperimentOptions& options);

}  // namespace plumescout::lab
