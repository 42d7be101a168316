// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [XIT] Fig. 5: gas frontiers cell by cell over three planning steps of a mission, with WGFD
// everywhere, as the figure's caption has it, and only around the robot, as Alg. 2 has it.
absl::StatusOr<Study> RunXitFig5(const ExperimentOptions& options);

}  // namespace plumescout::lab
