// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [MIT] Table I and Fig. 2: how often MIT, RRT and RRT* find each of three trajectories to be the
// most informative, in 250 runs; and the same in variants of the scene, which is ours.
absl::StatusOr<Study> RunMitTable1(const ExperimentOptions& options);

}  // namespace plumescout::lab
