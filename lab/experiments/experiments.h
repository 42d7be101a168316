// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "lab/experiments/study.h"

namespace plumescout::lab {

// Figures of the papers that can be made again, by name: "xit_fig3", ...
std::vector<std::string> ExperimentNames();

// Same options, same values. kInvalidArgument for an unknown name.
absl::StatusOr<Study> RunExperiment(const std::string& name, const ExperimentOptions& options);

}  // namespace plumescout::lab
