// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace plumescout::lab {

// `plumescout-lab replay`: makes the map of a recorded mission again, bit for bit. `status` is set
// when the command has run.
void AddReplayCommand(CLI::App& app, absl::Status& status);

}  // namespace plumescout::lab
