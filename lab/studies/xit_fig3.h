// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [XIT] Fig. 3: what the distance weight alpha does to one path, at the paper's values and where
// it does something in our units.
absl::StatusOr<Study> RunXitFig3(const ExperimentOptions& options);

}  // namespace plumescout::lab
