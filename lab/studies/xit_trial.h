// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [XIT] section VII with Fig. 11 and 12: the trial with carbon dioxide in a small arena, by a slow
// robot that stops to sample.
absl::StatusOr<Study> RunXitTrial(const ExperimentOptions& options);

}  // namespace plumescout::lab
