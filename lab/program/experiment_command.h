// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace plumescout::lab {

// `plumescout-lab experiment NAME`: makes a figure of the papers again. `status` is set when the
// command has run.
void AddExperimentCommand(CLI::App& app, absl::Status& status);

}  // namespace plumescout::lab
