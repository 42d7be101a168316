// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// What robots wait for when one of many servers dies, and how many robots one mission can have: a
// simulation of the protocol with costs that were measured (docs/scale.md).
absl::StatusOr<Study> RunClusterModel(const ExperimentOptions& options);

}  // namespace plumescout::lab
