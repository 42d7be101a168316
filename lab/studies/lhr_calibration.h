// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [LHR] Table II by the two numbers that the paper does not state, lambda_p of the field and beta
// of the reward: how near the distances and the times of its four rows by rewards come to those
// printed, in worlds that the table does not use. The rule: the pair with the least sum of squared
// logarithms of ours over theirs, and kLhrUnstated is that pair. Four worlds, four corners each;
// options.trials: worlds. Quick: one lambda_p, one world, one corner. Errors: as RunSamplingStudy.
absl::StatusOr<Study> RunLhrCalibration(const ExperimentOptions& options);

}  // namespace plumescout::lab
