// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace plumescout::lab {

// `plumescout-lab plan`: draws one planning step of a recorded mission, as plan.png with every
// number in plan.json. `status` is set when the command has run.
void AddPlanCommand(CLI::App& app, absl::Status& status);

}  // namespace plumescout::lab
