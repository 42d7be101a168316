// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace plumescout::lab {

// `plumescout-lab export`: writes a recorded mission as an MCAP file. `status` is set when the
// command has run.
void AddExportCommand(CLI::App& app, absl::Status& status);

}  // namespace plumescout::lab
