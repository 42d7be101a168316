// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// Missions of each objective in generated buildings that nothing was chosen in
// (docs/provenance.md), with a leak and without: when they stop, whether what they then say is so
// by the simulator's truth, what time that saves against a complete map, and whether robots with a
// deadline are home by then. With options.scenes: in these. Quick: one building, missions of 30 s.
absl::StatusOr<Study> RunObjectives(const ExperimentOptions& options);

}  // namespace plumescout::lab
