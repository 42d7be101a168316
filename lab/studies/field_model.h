// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// Gas maps by several models of the field from the same readings of the same missions: how far they
// are from the truth, and whether their variances say so. Missions are driven in generated
// buildings that no model was chosen in (docs/provenance.md).
absl::StatusOr<Study> RunFieldModel(const ExperimentOptions& options);

}  // namespace plumescout::lab
